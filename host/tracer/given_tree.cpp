#include "tracer/given_tree.hpp"

#include <algorithm>
#include <string>

#include "runtime/error.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t deepest = 4096;

[[noreturn]] void refuse(const std::string& what) {
  throw runtime::exception(runtime::errc::invalid, "the given tree " + what);
}

class maker {
 public:
  maker(const given_tree& given, std::span<const texel> corners)
      : given_(given), corners_(corners), count_(std::uint32_t(given.order.size())) {
    check_order();
    made_.order = given.order;
    made_.nodes.resize(2 * std::size_t(count_) - 1);
    made_.root = take(0, 0);
    if (next_ != count_)
      refuse("has " + std::to_string(next_) + " triangles in its leaves, and " +
             std::to_string(count_) + " in its order");
    made_.depth = made_.nodes[made_.root].height;
  }

  host_binary_tree finished() { return std::move(made_); }

 private:
  void check_order() const {
    if (3 * given_.order.size() != corners_.size() || given_.order.empty())
      refuse("has " + std::to_string(given_.order.size()) + " triangles, and the mesh " +
             std::to_string(corners_.size() / 3));
    std::vector<bool> seen(count_, false);
    for (const std::uint32_t t : given_.order) {
      if (t >= count_ || seen[t]) refuse("does not name each triangle once");
      seen[t] = true;
    }
  }

  /// The given node, as a node of the tree that is made; leaves must come in order.
  std::uint32_t take(std::size_t node, std::uint32_t above) {
    if (node >= given_.nodes.size() || above > deepest)
      refuse("has a child that is not there, or is deeper than " + std::to_string(deepest));
    const given_tree::node& n = given_.nodes[node];
    if (n.count == 0) {
      const std::uint32_t left = take(n.first, above + 1);
      return join(left, take(std::size_t(n.first) + 1, above + 1));
    }
    if (n.first != next_ || n.count > count_ - next_)
      refuse("has leaves that are not in order, or overlap");
    next_ += n.count;
    return halves(n.first, n.count);
  }

  std::uint32_t halves(std::uint32_t first, std::uint32_t count) {
    if (count == 1) return leaf(first);
    const std::uint32_t left = halves(first, count / 2);
    return join(left, halves(first + count / 2, count - count / 2));
  }

  std::uint32_t leaf(std::uint32_t at) {
    TreeNode& n = made_.nodes[at];
    n.left = given_.order[at];
    n.right = FACET_NONE;
    n.first = n.last = at;
    const texel* const p = &corners_[3 * std::size_t(n.left)];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      n.lo[axis] = std::min({p[0][axis], p[1][axis], p[2][axis]});
      n.hi[axis] = std::max({p[0][axis], p[1][axis], p[2][axis]});
    }
    return at;
  }

  std::uint32_t join(std::uint32_t left, std::uint32_t right) {
    const TreeNode &l = made_.nodes[left], &r = made_.nodes[right];
    const std::uint32_t id = count_ + l.last;
    TreeNode& n = made_.nodes[id];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      n.lo[axis] = std::min(l.lo[axis], r.lo[axis]);
      n.hi[axis] = std::max(l.hi[axis], r.hi[axis]);
    }
    n.left = left, n.right = right;
    n.first = l.first, n.last = r.last;
    n.height = 1 + std::max(l.height, r.height);
    return id;
  }

  const given_tree& given_;
  std::span<const texel> corners_;
  std::uint32_t count_, next_ = 0;
  host_binary_tree made_;
};

}  // namespace

host_binary_tree binary_of(const given_tree& given, std::span<const texel> corners) {
  return maker(given, corners).finished();
}

}  // namespace facet::tracer
