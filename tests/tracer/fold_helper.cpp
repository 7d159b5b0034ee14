#include "tracer/fold_helper.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace facet::test {
namespace {

constexpr std::size_t width = std::size(WideNode{}.child);
constexpr float most_area = std::numeric_limits<float>::max();

bool is_leaf(std::uint32_t child) { return child & FACET_LEAF_BIT; }

float area_of_half(const float lo[3], const float hi[3]) {
  const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
  return (x * y + y * z) + z * x;
}

void set_bounds(Node& n, std::size_t side, const Box& b) {
  n.x[0][side] = b.lo[0], n.x[1][side] = b.hi[0];
  n.y[0][side] = b.lo[1], n.y[1][side] = b.hi[1];
  n.z[0][side] = b.lo[2], n.z[1][side] = b.hi[2];
}

class tree_maker {
 public:
  tree_maker(std::uint32_t leaves, std::uint32_t most, const split& s,
             const std::function<Box()>& box, std::uint64_t seed)
      : split_(s), box_(box), random_(seed), most_(most), free_(leaves - 1) {
    made_.nodes.resize(leaves - 1);
    std::iota(free_.begin(), free_.end(), 0u);
    for (std::size_t i = free_.size(); i > 1; --i)
      std::swap(free_[i - 1], free_[random_.below(std::uint32_t(i))]);
    made_.root = make(leaves).first;
  }
  host_node_tree take() { return std::move(made_); }

 private:
  std::pair<std::uint32_t, Box> make(std::uint32_t leaves) {
    if (leaves == 1) {
      const std::uint32_t size = 1 + random_.below(most_), first = made_.count;
      made_.count += size;
      return {FACET_LEAF(first, size), box_()};
    }
    const std::uint32_t at = free_.back(), on_left = split_(leaves);
    free_.pop_back();
    const auto [left, l] = make(on_left);
    const auto [right, r] = make(leaves - on_left);
    Node n{};
    n.child[0] = left, n.child[1] = right;
    set_bounds(n, 0, l), set_bounds(n, 1, r);
    made_.nodes[at] = n;
    Box both{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      both.lo[axis] = std::min(l.lo[axis], r.lo[axis]);
      both.hi[axis] = std::max(l.hi[axis], r.hi[axis]);
    }
    return {at, both};
  }

  const split& split_;
  const std::function<Box()>& box_;
  random random_;
  std::uint32_t most_;
  std::vector<std::uint32_t> free_;
  host_node_tree made_;
};

/// A child of a wide node: the side of a node above it.
struct place {
  std::uint32_t node;
  std::size_t side;
};

class folder {
 public:
  folder(const host_node_tree& from, std::uint32_t first_node, std::uint32_t first_leaf)
      : from_(from),
        first_node_(first_node),
        first_leaf_(first_leaf),
        entry_of_(from.nodes.size()) {
    if (!is_leaf(from.root)) plan(from.root);
    to_.root = fold(from.root, 0);
  }
  host_fold take() { return std::move(to_); }

 private:
  /// [k - 1]: the least cost of a subtree that has k places among the children of a node above, and
  /// how many of them its left side takes; 0: it makes do with one place less, or is a child.
  struct entry {
    /// Where no cost is finite, both sides take half of the places.
    entry() {
      cost.fill(most_area);
      for (std::size_t k = 1; k <= width; ++k) left[k - 1] = k / 2;
    }
    std::array<float, width> cost;
    std::array<std::size_t, width> left;
    std::size_t own = 0;  ///< places of the left side where it is a node itself
  };

  float cost(std::uint32_t child, std::size_t places) const {
    return is_leaf(child) ? 0.0f : entry_of_[child].cost[places - 1];
  }

  void plan(std::uint32_t i) {
    const Node& n = from_.nodes[i];
    for (const std::uint32_t child : n.child)
      if (!is_leaf(child)) plan(child);
    entry e;
    for (std::size_t k = 2; k <= width; ++k)
      for (std::size_t left = 1; left < k; ++left)
        if (const float c = cost(n.child[0], left) + cost(n.child[1], k - left); c < e.cost[k - 1])
          e.cost[k - 1] = c, e.left[k - 1] = left;
    e.own = e.left[width - 1];
    e.cost[0] = test::half_area(n) + e.cost[width - 1];
    // Fewer places are as good as more if these cost no less.
    for (std::size_t k = 2; k <= width; ++k)
      if (e.cost[k - 1] >= e.cost[k - 2]) e.cost[k - 1] = e.cost[k - 2], e.left[k - 1] = 0;
    entry_of_[i] = e;
  }

  void gather(place p, std::size_t places, std::vector<place>& to) const {
    const std::uint32_t i = from_.nodes[p.node].child[p.side];
    if (!is_leaf(i))
      while (places > 1 && entry_of_[i].left[places - 1] == 0) --places;
    if (is_leaf(i) || places == 1) {
      to.push_back(p);
      return;
    }
    const std::size_t left = entry_of_[i].left[places - 1];
    gather({i, 0}, left, to);
    gather({i, 1}, places - left, to);
  }

  std::uint32_t fold(std::uint32_t i, std::uint32_t above) {
    if (is_leaf(i)) {
      to_.leaves.push_back(i);
      return FACET_LEAF(first_leaf_ + std::uint32_t(to_.leaves.size()) - 1, 1u);
    }
    std::vector<place> children;
    gather({i, 0}, entry_of_[i].own, children);
    gather({i, 1}, width - entry_of_[i].own, children);
    const std::size_t at = to_.nodes.size();
    to_.nodes.emplace_back();
    to_.depth = std::max(to_.depth, above + 1);
    WideNode n{};
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < width; ++k) {
      if (k >= children.size()) {
        n.x[0][k] = n.y[0][k] = n.z[0][k] = infinity;
        n.x[1][k] = n.y[1][k] = n.z[1][k] = -infinity;
        n.child[k] = FACET_NONE;
        continue;
      }
      const auto [node, side] = children[k];
      const Node& from = from_.nodes[node];
      for (const std::size_t end : {0, 1}) {
        n.x[end][k] = from.x[end][side];
        n.y[end][k] = from.y[end][side];
        n.z[end][k] = from.z[end][side];
      }
      n.child[k] = fold(from.child[side], above + 1);
    }
    to_.nodes[at] = n;
    return first_node_ + std::uint32_t(at);
  }

  const host_node_tree& from_;
  std::uint32_t first_node_, first_leaf_;
  std::vector<entry> entry_of_;
  host_fold to_;
};

}  // namespace

host_node_tree made_tree(std::uint32_t leaves, std::uint32_t most, const split& s,
                         const std::function<Box()>& box, std::uint64_t seed) {
  return tree_maker(leaves, most, s, box, seed).take();
}

host_fold folded(const host_node_tree& from, std::uint32_t first_node, std::uint32_t first_leaf) {
  return folder(from, first_node, first_leaf).take();
}

float half_area(const Node& n, std::size_t side) {
  const float lo[3] = {n.x[0][side], n.y[0][side], n.z[0][side]};
  const float hi[3] = {n.x[1][side], n.y[1][side], n.z[1][side]};
  return area_of_half(lo, hi);
}

float half_area(const Node& n) {
  const auto least = [](const float* v) { return std::min(v[0], v[1]); };
  const auto most = [](const float* v) { return std::max(v[0], v[1]); };
  const float lo[3] = {least(n.x[0]), least(n.y[0]), least(n.z[0])};
  const float hi[3] = {most(n.x[1]), most(n.y[1]), most(n.z[1])};
  return area_of_half(lo, hi);
}

}  // namespace facet::test
