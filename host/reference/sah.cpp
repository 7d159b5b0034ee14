#include "reference/sah.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace facet::reference {
namespace {

constexpr int bins = 32;
constexpr std::size_t sweep_below = 128;  ///< boxes: fewer are sorted and swept, more are binned

struct split {
  float cost = INFINITY;
  int axis = -1;
  std::size_t left = 0;  ///< sweep: boxes on the left after sorting by centre
  int bin = 0;           ///< binned: the last bin on the left
};

class builder {
 public:
  builder(std::span<const box3f> boxes, unsigned leaf_size) : boxes_(boxes), leaf_size_(leaf_size) {
    tree_.order.resize(boxes.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0u);
    if (boxes.empty()) return;
    tree_.nodes.reserve(boxes.size());
    tree_.nodes.emplace_back();
    subdivide(0, 0, boxes.size(), 0);
  }

  sah_tree take() { return std::move(tree_); }

 private:
  float centre(std::uint32_t box, int axis) const {
    return boxes_[box].lo[axis] * 0.5f + boxes_[box].hi[axis] * 0.5f;
  }
  float leaves(std::size_t count) const { return float((count + leaf_size_ - 1) / leaf_size_); }

  void subdivide(std::size_t node, std::size_t first, std::size_t count, unsigned depth) {
    box3f box, centres;
    for (std::size_t i = first; i < first + count; ++i) {
      const std::uint32_t b = tree_.order[i];
      box.add(boxes_[b]);
      centres.add(vec3f(centre(b, 0), centre(b, 1), centre(b, 2)));
    }
    tree_.nodes[node].box = box;
    if (count <= leaf_size_) {
      tree_.nodes[node].first = std::uint32_t(first);
      tree_.nodes[node].count = std::uint32_t(count);
      return;
    }
    std::size_t left = 0;
    if (depth < sah_free_depth)
      left = count < sweep_below ? sweep(first, count) : binned(first, count, centres);
    if (left == 0) left = halve(first, count, centres);

    const std::size_t children = tree_.nodes.size();
    tree_.nodes[node].first = std::uint32_t(children);
    tree_.nodes.emplace_back();
    tree_.nodes.emplace_back();
    subdivide(children, first, left, depth + 1);
    subdivide(children + 1, first + left, count - left, depth + 1);
  }

  void sort(std::size_t first, std::size_t count, int axis) {
    const auto begin = tree_.order.begin() + std::ptrdiff_t(first);
    std::sort(begin, begin + std::ptrdiff_t(count), [&](std::uint32_t a, std::uint32_t b) {
      const float ca = centre(a, axis), cb = centre(b, axis);
      return ca != cb ? ca < cb : a < b;
    });
  }

  /// Number of boxes that go left after sorting; 0 if no split has a finite cost.
  std::size_t sweep(std::size_t first, std::size_t count) {
    split best;
    std::array<float, sweep_below> right{};
    for (int axis = 0; axis < 3; ++axis) {
      sort(first, count, axis);
      box3f box;
      for (std::size_t i = count; i-- > 1;) {
        box.add(boxes_[tree_.order[first + i]]);
        right[i] = box.half_area() * leaves(count - i);
      }
      box = {};
      for (std::size_t i = 1; i < count; ++i) {
        box.add(boxes_[tree_.order[first + i - 1]]);
        const float cost = box.half_area() * leaves(i) + right[i];
        if (cost < best.cost) best = {cost, axis, i, 0};
      }
    }
    if (best.left > 0 && best.axis != 2) sort(first, count, best.axis);
    return best.left;
  }

  static int bin_of(float c, float lo, float scale) {
    return std::clamp(int((c - lo) * scale), 0, bins - 1);
  }

  std::size_t binned(std::size_t first, std::size_t count, const box3f& centres) {
    split best;
    vec3f scale;
    for (int axis = 0; axis < 3; ++axis) {
      const float extent = centres.extent()[axis];
      scale[axis] = float(bins) / extent;
      if (!(extent > 0 && extent < INFINITY && scale[axis] < INFINITY)) continue;
      std::array<box3f, bins> box;
      std::array<std::size_t, bins> size{};
      for (std::size_t i = first; i < first + count; ++i) {
        const std::uint32_t b = tree_.order[i];
        const auto k = std::size_t(bin_of(centre(b, axis), centres.lo[axis], scale[axis]));
        box[k].add(boxes_[b]);
        ++size[k];
      }
      std::array<float, bins> right{};
      box3f sum;
      std::size_t n = 0;
      for (std::size_t k = bins; k-- > 1;) {
        sum.add(box[k]), n += size[k];
        right[k] = n == 0 ? INFINITY : sum.half_area() * leaves(n);
      }
      sum = {}, n = 0;
      for (std::size_t k = 0; k + 1 < bins; ++k) {
        sum.add(box[k]), n += size[k];
        const float cost = n == 0 ? INFINITY : sum.half_area() * leaves(n) + right[k + 1];
        if (cost < best.cost) best = {cost, axis, 0, int(k)};
      }
    }
    if (best.axis < 0) return 0;
    const auto begin = tree_.order.begin() + std::ptrdiff_t(first);
    const auto middle = std::partition(begin, begin + std::ptrdiff_t(count), [&](std::uint32_t b) {
      return bin_of(centre(b, best.axis), centres.lo[best.axis], scale[best.axis]) <= best.bin;
    });
    return std::size_t(middle - begin);
  }

  /// Two halves by number along the widest axis: always possible, whatever the boxes.
  std::size_t halve(std::size_t first, std::size_t count, const box3f& centres) {
    const vec3f e = centres.extent();
    sort(first, count, e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2));
    return count / 2;
  }

  std::span<const box3f> boxes_;
  std::size_t leaf_size_;
  sah_tree tree_;
};

}  // namespace

sah_tree build_sah(std::span<const box3f> boxes, unsigned leaf_size) {
  return builder(boxes, leaf_size).take();
}

}  // namespace facet::reference
