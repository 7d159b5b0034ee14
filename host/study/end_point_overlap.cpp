#include "study/end_point_overlap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace facet::study {
namespace {

/// A convex polygon in space: a triangle, less what lies outside some boxes. Each of a box's six
/// planes adds a corner at most, and none that cut before adds another.
class polygon {
 public:
  explicit polygon(const std::array<vec3d, 3>& triangle) : size_(3) {
    std::copy(triangle.begin(), triangle.end(), at_.begin());
  }

  double area() const {
    vec3d sum;
    for (std::size_t i = 2; i < size_; ++i) sum = sum + cross(at_[i - 1] - at_[0], at_[i] - at_[0]);
    return 0.5 * length(sum);
  }

  /// Sutherland and Hodgman's clipping, plane by plane.
  void clip(const box3f& b) {
    for (int axis = 0; axis < 3 && size_ > 0; ++axis) {
      cut(axis, double(b.lo[axis]), 1);
      cut(axis, double(b.hi[axis]), -1);
    }
  }

 private:
  /// Leaves what lies where sign * coordinate >= sign * plane.
  void cut(int axis, double plane, double sign) {
    std::array<double, most> above;
    bool any = false, all = true;
    for (std::size_t i = 0; i < size_; ++i) {
      above[i] = sign * (at_[i][axis] - plane);
      any = any || above[i] >= 0;
      all = all && above[i] >= 0;
    }
    if (all) return;
    if (!any) {
      size_ = 0;
      return;
    }
    std::array<vec3d, most> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const std::size_t j = i + 1 < size_ ? i + 1 : 0;
      if (above[i] >= 0) kept[count++] = at_[i];
      if ((above[i] > 0 && above[j] < 0) || (above[i] < 0 && above[j] > 0)) {
        vec3d p = at_[i] + (at_[j] - at_[i]) * (above[i] / (above[i] - above[j]));
        p[axis] = plane;
        kept[count++] = p;
      }
    }
    at_ = kept;
    size_ = count;
  }

  static constexpr std::size_t most = 16;  ///< nine, and room for corners that rounding adds
  std::array<vec3d, most> at_;
  std::size_t size_;
};

class measurer {
 public:
  measurer(const tracer::plain_tree& t, std::span<const tracer::texel> corners)
      : tree_(t), corners_(corners), position_(corners.size() / 3), ends_(t.nodes.size()) {
    // Leaves in the order of a walk down: a node's subtree is a run of it.
    number();
  }

  std::array<vec3d, 3> triangle(std::size_t i) const {
    std::array<vec3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      const tracer::texel& c = corners_[3 * i + k];
      p[k] = {double(c[0]), double(c[1]), double(c[2])};
    }
    return p;
  }

  /// Sum over the nodes that do not hold triangle i of C times the area of it in their boxes.
  double overlap(std::size_t i) {
    double sum = 0;
    waiting_.assign(1, {0, polygon(triangle(i))});
    while (!waiting_.empty()) {
      const entry e = waiting_.back();
      waiting_.pop_back();
      const auto& n = tree_.nodes[e.node];
      if (n.is_leaf) continue;
      for (std::uint32_t c = n.first; c < n.first + n.count; ++c) {
        const auto& child = tree_.nodes[c];
        entry below{c, e.rest};
        if (!(ends_[c].first <= position_[i] && position_[i] < ends_[c].last)) {
          below.rest.clip(child.box);
          const double area = below.rest.area();
          if (!(area > 0)) continue;
          sum += area * (child.is_leaf ? child.count : 1);
        }
        waiting_.push_back(below);
      }
    }
    return sum;
  }

 private:
  struct run {
    std::uint32_t first, last;
  };
  struct entry {
    std::uint32_t node;
    polygon rest;  ///< of the triangle, in the node's box
  };

  void number() {
    std::uint32_t next = 0;
    std::vector<std::uint32_t> way{0};
    while (!way.empty()) {
      const std::uint32_t at = way.back();
      way.pop_back();
      const auto& n = tree_.nodes[at];
      ends_[at].first = next;
      if (n.is_leaf) {
        for (std::uint32_t k = 0; k < n.count; ++k)
          position_[tree_.primitives[n.first + k]] = next++;
        ends_[at].last = next;
      } else {
        for (std::uint32_t c = n.count; c-- > 0;) way.push_back(n.first + c);
      }
    }
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {  // children stand behind their node
      const auto& n = tree_.nodes[i];
      if (!n.is_leaf) ends_[i].last = ends_[n.first + n.count - 1].last;
    }
  }

  const tracer::plain_tree& tree_;
  std::span<const tracer::texel> corners_;
  std::vector<std::uint32_t> position_;  ///< by triangle: in the order of the leaves
  std::vector<run> ends_;                ///< by node: the positions in its subtree
  std::vector<entry> waiting_;
};

}  // namespace

end_point_overlap overlap_of(const tracer::plain_tree& t, std::span<const tracer::texel> corners,
                             std::uint64_t samples, std::uint64_t seed) {
  end_point_overlap found;
  if (t.nodes.empty()) return found;
  measurer m(t, corners);
  const std::size_t count = corners.size() / 3;
  std::vector<double> upto(count);  // area of the triangles up to and with this one
  double surface = 0;
  for (std::size_t i = 0; i < count; ++i) upto[i] = surface += polygon(m.triangle(i)).area();
  if (!(surface > 0)) return found;
  if (count <= samples) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += m.overlap(i);
    found.value = sum / surface;
    found.triangles = count;
    return found;
  }
  std::mt19937_64 bits(seed);
  double mean = 0, squares = 0;  // Welford's
  for (std::uint64_t k = 1; k <= samples; ++k) {
    const double at = surface * (double(bits() >> 11) * 0x1p-53);
    const auto i = std::size_t(std::upper_bound(upto.begin(), upto.end(), at) - upto.begin());
    const double share = m.overlap(i) / polygon(m.triangle(i)).area();
    const double off = share - mean;
    mean += off / double(k);
    squares += off * (share - mean);
  }
  found.value = mean;
  found.standard_error = std::sqrt(squares / double(samples - 1) / double(samples));
  found.triangles = samples;
  found.is_sampled = true;
  return found;
}

}  // namespace facet::study
