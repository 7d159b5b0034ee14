#include "reference/full_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

namespace facet::reference {
namespace {

class sweeper {
 public:
  sweeper(std::span<const box3f> boxes, unsigned most_in_leaf)
      : boxes_(boxes), most_in_leaf_(most_in_leaf), scratch_(boxes.size()), right_(boxes.size()) {
    if (boxes.empty()) return;
    goes_left_.resize(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<std::uint32_t>& order = sorted_[std::size_t(axis)];
      order.resize(boxes.size());
      std::iota(order.begin(), order.end(), 0u);
      std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        const float ca = centre(a, axis), cb = centre(b, axis);
        return ca != cb ? ca < cb : a < b;
      });
    }
    tree_.nodes.reserve(2 * boxes.size() - 1);
    tree_.nodes.emplace_back();
    subdivide(0, 0, boxes.size(), 0);
    tree_.order = std::move(sorted_[0]);
  }

  sah_tree take() { return std::move(tree_); }

 private:
  struct split {
    double cost;
    int axis;
    std::size_t left;
  };

  float centre(std::uint32_t box, int axis) const {
    return boxes_[box].lo[axis] * 0.5f + boxes_[box].hi[axis] * 0.5f;
  }
  std::span<std::uint32_t> sorted(int axis, std::size_t first, std::size_t count) {
    return std::span(sorted_[std::size_t(axis)]).subspan(first, count);
  }
  /// In double: sums of float areas over many triangles must not overflow, nor lose small ones.
  static double area(const box3f& b) { return box3d{vec3d(b.lo), vec3d(b.hi)}.half_area(); }

  /// Makes the subtree over these positions of the sorted orders; returns its cost times its
  /// node's half area.
  double subdivide(std::size_t node, std::size_t first, std::size_t count, unsigned depth) {
    box3f box;
    for (const std::uint32_t b : sorted(0, first, count)) box.add(boxes_[b]);
    const double as_leaf = area(box) * double(count);
    tree_.nodes[node].box = box;
    if (count > 1) {
      const split best = depth < sah_free_depth ? swept(first, count) : halves(first, count);
      divide(best, first, count);
      const std::size_t children = tree_.nodes.size();
      tree_.nodes[node].first = std::uint32_t(children);
      tree_.nodes.emplace_back();
      tree_.nodes.emplace_back();
      const double cost =
          area(box) + (subdivide(children, first, best.left, depth + 1) +
                       subdivide(children + 1, first + best.left, count - best.left, depth + 1));
      if (count > most_in_leaf_ || cost < as_leaf) return cost;
      tree_.nodes.resize(children);
    }
    tree_.nodes[node].first = std::uint32_t(first);
    tree_.nodes[node].count = std::uint32_t(count);
    return as_leaf;
  }

  split swept(std::size_t first, std::size_t count) {
    split best{INFINITY, 0, count / 2};
    for (int axis = 0; axis < 3; ++axis) {
      const auto order = sorted(axis, first, count);
      box3f box;
      for (std::size_t i = count; i-- > 1;) {
        box.add(boxes_[order[i]]);
        right_[i] = area(box) * double(count - i);
      }
      box = {};
      for (std::size_t i = 1; i < count; ++i) {
        box.add(boxes_[order[i - 1]]);
        const double cost = area(box) * double(i) + right_[i];
        if (cost < best.cost) best = {cost, axis, i};
      }
    }
    return best;
  }

  /// Two halves by number along the axis on which the centres spread most.
  split halves(std::size_t first, std::size_t count) {
    split best{0, 0, count / 2};
    float widest = -1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto order = sorted(axis, first, count);
      const float spread = centre(order.back(), axis) - centre(order.front(), axis);
      if (spread > widest) widest = spread, best.axis = axis;
    }
    return best;
  }

  /// Moves each side's boxes together in all three orders, which stay sorted within it.
  void divide(const split& by, std::size_t first, std::size_t count) {
    const auto chosen = sorted(by.axis, first, count);
    for (std::size_t i = 0; i < count; ++i) goes_left_[chosen[i]] = i < by.left;
    for (int axis = 0; axis < 3; ++axis) {
      if (axis == by.axis) continue;
      const auto order = sorted(axis, first, count);
      std::size_t left = 0, right = 0;
      for (const std::uint32_t b : order)
        if (goes_left_[b])
          order[left++] = b;
        else
          scratch_[right++] = b;
      std::copy_n(scratch_.begin(), right, order.begin() + std::ptrdiff_t(left));
    }
  }

  std::span<const box3f> boxes_;
  std::size_t most_in_leaf_;
  std::array<std::vector<std::uint32_t>, 3> sorted_;  ///< boxes by centre, node by node
  std::vector<std::uint8_t> goes_left_;               ///< by box
  std::vector<std::uint32_t> scratch_;
  std::vector<double> right_;  ///< [i]: cost of the boxes from i on
  sah_tree tree_;
};

}  // namespace

sah_tree sweep_sah(std::span<const box3f> boxes, unsigned most_in_leaf) {
  return sweeper(boxes, most_in_leaf).take();
}

}  // namespace facet::reference
