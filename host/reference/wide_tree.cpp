#include "reference/wide_tree.hpp"

#include <limits>

namespace facet::reference {
namespace {

class folder {
 public:
  folder(const sah_tree& from, wide_tree& to) : from_(from), to_(to) {}

  /// The child that stands for the binary node `i`, its nodes and leaves appended.
  std::uint32_t fold(std::uint32_t i) {
    const sah_node& n = from_.nodes[i];
    if (n.is_leaf()) {
      to_.leaf_first.push_back(std::uint32_t(to_.order.size()));
      const auto boxes = std::span(from_.order).subspan(n.first, n.count);
      to_.order.insert(to_.order.end(), boxes.begin(), boxes.end());
      return leaf_bit | std::uint32_t(to_.leaf_first.size() - 1);
    }
    std::array<std::uint32_t, tree_width> child{n.first, n.first + 1};
    std::size_t count = 2;
    while (count < tree_width && open_largest(child, count)) ++count;

    const std::size_t at = to_.nodes.size();
    to_.nodes.push_back(empty_node());
    for (std::size_t k = 0; k < count; ++k) {
      const box3f& b = from_.nodes[child[k]].box;
      const std::uint32_t folded = fold(child[k]);
      wide_node& node = to_.nodes[at];
      for (int axis = 0; axis < 3; ++axis) {
        node.plane[std::size_t(2 * axis)][k] = b.lo[axis];
        node.plane[std::size_t(2 * axis + 1)][k] = b.hi[axis];
      }
      node.child[k] = folded;
    }
    return std::uint32_t(at);
  }

 private:
  static wide_node empty_node() {
    constexpr float most = std::numeric_limits<float>::max();
    wide_node n;
    for (std::size_t i = 0; i < 6; ++i) n.plane[i].fill(i % 2 == 0 ? most : -most);
    n.child.fill(no_child);
    return n;
  }

  /// Replaces the inner child with the largest surface by its two children.
  bool open_largest(std::array<std::uint32_t, tree_width>& child, std::size_t count) const {
    std::size_t largest = count;
    float area = -1;
    for (std::size_t k = 0; k < count; ++k) {
      const sah_node& n = from_.nodes[child[k]];
      if (!n.is_leaf() && n.box.half_area() > area) largest = k, area = n.box.half_area();
    }
    if (largest == count) return false;
    child[count] = from_.nodes[child[largest]].first + 1;
    child[largest] = from_.nodes[child[largest]].first;
    return true;
  }

  const sah_tree& from_;
  wide_tree& to_;
};

}  // namespace

wide_tree::wide_tree(std::span<const box3f> boxes, unsigned leaf_size) {
  const sah_tree binary = build_sah(boxes, leaf_size);
  if (!binary.nodes.empty()) root = folder(binary, *this).fold(0);
  leaf_first.push_back(std::uint32_t(order.size()));
}

}  // namespace facet::reference
