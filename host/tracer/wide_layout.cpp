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

using children = std::array<std::uint32_t, width>;

/// Which nodes of the binary tree become a wide node's children: of all ways to fold, the one with
/// the least sum of areas over wide nodes, which is what they cost a ray (Ylitie, Karras and Laine,
/// HPG 2017). Leaves are what they are.
class plan {
 public:
  plan(std::span<const TreeNode> from, std::uint32_t lanes, std::uint32_t count)
      : from_(from), lanes_(lanes), count_(count), entry_of_(count - 1) {}

  bool is_leaf(std::uint32_t i) const { return from_[i].last - from_[i].first < lanes_; }

  /// Must be called for a node, which is no leaf, before its children are asked for.
  void make(std::uint32_t i) {
    const std::uint32_t l = from_[i].left, r = from_[i].right;
    if (!is_leaf(l)) make(l);
    if (!is_leaf(r)) make(r);
    entry e;
    for (std::size_t k = 2; k <= width; ++k)
      for (std::size_t left = 1; left < k; ++left)
        if (const float c = cost(l, left) + cost(r, k - left); c < e.cost[k - 1])
          e.cost[k - 1] = c, e.left[k - 1] = std::uint8_t(left);
    e.own = e.left[width - 1];
    e.cost[0] = half_area(from_[i]) + e.cost[width - 1];
    // Fewer places are as good as more if these cost no less.
    for (std::size_t k = 2; k <= width; ++k)
      if (e.cost[k - 1] >= e.cost[k - 2]) e.cost[k - 1] = e.cost[k - 2], e.left[k - 1] = 0;
    entry_of_[i - count_] = std::uint32_t(entries_.size());
    entries_.push_back(e);
  }

  /// The children of the wide node that stands for node i, from the left; gives how many.
  std::size_t children_of(std::uint32_t i, children& to) const {
    std::size_t count = 0;
    const std::size_t left = at(i).own;
    gather(from_[i].left, left, to, count);
    gather(from_[i].right, width - left, to, count);
    return count;
  }

 private:
  /// [k - 1]: the least cost of a subtree that has k places among the children of a node above,
  /// and how many of them its left side takes; 0: it makes do with one place less, or is a child.
  struct entry {
    /// Where no cost is finite, both sides take half of the places.
    entry() {
      cost.fill(std::numeric_limits<float>::infinity());
      for (std::size_t k = 1; k <= width; ++k) left[k - 1] = std::uint8_t(k / 2);
    }
    std::array<float, width> cost;
    std::array<std::uint8_t, width> left;
    std::uint8_t own = 0;  ///< places of the left side where it is a node itself
  };

  const entry& at(std::uint32_t i) const { return entries_[entry_of_[i - count_]]; }
  float cost(std::uint32_t i, std::size_t places) const {
    return is_leaf(i) ? 0.0f : at(i).cost[places - 1];
  }

  void gather(std::uint32_t i, std::size_t places, children& to, std::size_t& count) const {
    if (!is_leaf(i))
      while (places > 1 && at(i).left[places - 1] == 0) --places;
    if (is_leaf(i) || places == 1) {
      to[count++] = i;
      return;
    }
    const std::size_t left = at(i).left[places - 1];
    gather(from_[i].left, left, to, count);
    gather(from_[i].right, places - left, to, count);
  }

  std::span<const TreeNode> from_;
  std::uint32_t lanes_, count_;
  std::vector<entry> entries_;           ///< of nodes that are no leaves
  std::vector<std::uint32_t> entry_of_;  ///< by node less count
};

class folder {
 public:
  folder(std::span<const TreeNode> from, std::uint32_t root, std::uint32_t count,
         std::uint32_t lanes, std::uint32_t first_node, std::uint32_t first_leaf)
      : from_(from),
        plan_(from, lanes, count),
        lanes_(lanes),
        first_node_(first_node),
        first_leaf_(first_leaf) {
    if (!plan_.is_leaf(root)) plan_.make(root);
    to_.root = fold(root, 0);
  }

  wide_tree take() { return std::move(to_); }

 private:
  /// How the subtree is named as a child; its nodes and leaves are appended. `above`: the nodes
  /// over it.
  std::uint32_t fold(std::uint32_t i, std::uint32_t above) {
    if (plan_.is_leaf(i)) return leaf(i);
    children child;
    const std::size_t count = plan_.children_of(i, child);
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

  std::uint32_t size(std::uint32_t i) const { return from_[i].last - from_[i].first + 1; }

  std::uint32_t leaf(std::uint32_t i) {
    const auto number = std::uint32_t(to_.order.size() / lanes_);
    for (std::uint32_t k = 0; k < lanes_; ++k)
      to_.order.push_back(k < size(i) ? from_[from_[i].first + k].left : FACET_NONE);
    return FACET_LEAF(first_leaf_ + number, 1u);
  }

  std::span<const TreeNode> from_;
  plan plan_;
  std::uint32_t lanes_, first_node_, first_leaf_;
  wide_tree to_;
};

}  // namespace

wide_tree widened(std::span<const TreeNode> binary, std::uint32_t root, std::uint32_t count,
                  std::uint32_t lanes, std::uint32_t first_node, std::uint32_t first_leaf) {
  return folder(binary.first(2 * std::size_t(count) - 1), root, count, lanes, first_node,
                first_leaf)
      .take();
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
