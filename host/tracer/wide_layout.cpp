#include "tracer/wide_layout.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace facet::tracer {
namespace {

constexpr std::size_t width = std::size(WideNode{}.child);

float half_area(const TreeNode& n) {
  const float x = n.hi[0] - n.lo[0], y = n.hi[1] - n.lo[1], z = n.hi[2] - n.lo[2];
  return (x * y + y * z) + z * x;
}

/// Bounds that no ray meets.
WideNode empty_node() {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  WideNode n{};
  for (auto* axis : {&n.x, &n.y, &n.z}) {
    std::fill(std::begin((*axis)[0]), std::end((*axis)[0]), infinity);
    std::fill(std::begin((*axis)[1]), std::end((*axis)[1]), -infinity);
  }
  std::fill(std::begin(n.child), std::end(n.child), FACET_NONE);
  return n;
}

void set_bounds(WideNode& to, std::size_t k, const TreeNode& n) {
  to.x[0][k] = n.lo[0], to.x[1][k] = n.hi[0];
  to.y[0][k] = n.lo[1], to.y[1][k] = n.hi[1];
  to.z[0][k] = n.lo[2], to.z[1][k] = n.hi[2];
}

class folder {
 public:
  folder(std::span<const TreeNode> from, std::uint32_t lanes, std::uint32_t first_node,
         std::uint32_t first_leaf)
      : from_(from), lanes_(lanes), first_node_(first_node), first_leaf_(first_leaf) {}

  /// How the subtree is named as a child; its nodes and leaves are appended. `above`: the nodes
  /// over it.
  std::uint32_t fold(std::uint32_t i, std::uint32_t above) {
    if (is_leaf(i)) return leaf(i);
    std::array<std::uint32_t, width> child{from_[i].left, from_[i].right};
    std::size_t count = 2;
    while (count < width && open_largest(child, count)) ++count;

    const std::size_t at = to_.nodes.size();
    to_.nodes.push_back(empty_node());
    to_.depth = std::max(to_.depth, above + 1);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t folded = fold(child[k], above + 1);
      set_bounds(to_.nodes[at], k, from_[child[k]]);
      to_.nodes[at].child[k] = folded;
    }
    return first_node_ + std::uint32_t(at);
  }

  wide_tree take() { return std::move(to_); }

 private:
  std::uint32_t size(std::uint32_t i) const { return from_[i].last - from_[i].first + 1; }
  bool is_leaf(std::uint32_t i) const { return size(i) <= lanes_; }

  std::uint32_t leaf(std::uint32_t i) {
    const auto number = std::uint32_t(to_.order.size() / lanes_);
    for (std::uint32_t k = 0; k < lanes_; ++k)
      to_.order.push_back(k < size(i) ? from_[from_[i].first + k].left : FACET_NONE);
    return FACET_LEAF(first_leaf_ + number, 1u);
  }

  /// Replaces the inner child with the largest surface by its two children.
  bool open_largest(std::array<std::uint32_t, width>& child, std::size_t count) const {
    std::size_t largest = count;
    float area = -1;
    for (std::size_t k = 0; k < count; ++k)
      if (!is_leaf(child[k]) && half_area(from_[child[k]]) > area)
        largest = k, area = half_area(from_[child[k]]);
    if (largest == count) return false;
    child[count] = from_[child[largest]].right;
    child[largest] = from_[child[largest]].left;
    return true;
  }

  std::span<const TreeNode> from_;
  std::uint32_t lanes_, first_node_, first_leaf_;
  wide_tree to_;
};

}  // namespace

wide_tree widened(std::span<const TreeNode> binary, std::uint32_t root, std::uint32_t count,
                  std::uint32_t lanes, std::uint32_t first_node, std::uint32_t first_leaf) {
  folder f(binary.first(2 * std::size_t(count) - 1), lanes, first_node, first_leaf);
  const std::uint32_t named = f.fold(root, 0);
  wide_tree t = f.take();
  t.root = named;
  return t;
}

void append_blocks(std::span<const std::uint32_t> order, std::span<const texel> corners,
                   std::vector<TriangleBlock>& blocks) {
  for (std::size_t first = 0; first < order.size(); first += FACET_BLOCK) {
    TriangleBlock& b = blocks.emplace_back();
    const texel* const p = &corners[3 * std::size_t(order[first])];
    const std::array<texel, 3> absent{p[0], p[0], p[1] == p[0] ? p[2] : p[1]};
    for (std::size_t lane = 0; lane < FACET_BLOCK; ++lane) {
      const std::uint32_t triangle = order[first + lane];
      const texel* const from =
          triangle == FACET_NONE ? absent.data() : &corners[3 * std::size_t(triangle)];
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis) b.corner[k][axis][lane] = from[k][axis];
    }
  }
}

}  // namespace facet::tracer
