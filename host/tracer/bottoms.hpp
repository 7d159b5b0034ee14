// Trees over the subtrees that tracer/subtrees.hpp lists (cl/bottom.cl, cl/serial_tree.cl).
#pragma once

#include <cstdint>
#include <string>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/leaf_order.hpp"
#include "tracer/leaf_rule.hpp"
#include "tracer/pack.hpp"
#include "tracer/program_set.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// What the top tree is built over, and where nodes go.
struct tree_parts {
  runtime::buffer<Node> nodes;
  runtime::buffer<Item> items;
  runtime::buffer<std::uint32_t> refs;  ///< what each item is as a node's child
};

/// The options of kernels that make leaves, for the compiler. in_order: they put triangles into
/// leaf order (cl/leaf_order.h).
std::string leaf_options(leaf_rule leaves, bool in_order);

/// The arguments that this takes, the first of them number `k`.
void set_leaf_triangles(runtime::handler& h, std::uint32_t k, const leaf_triangles& sorted);

/// Primitive is texel (triangles) or Box.
template <class Primitive>
class bottoms {
 public:
  bottoms(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
          leaf_rule leaves, bool in_order);

  /// order: sorted place -> primitive; becomes leaf place -> primitive. Nodes are appended from
  /// first_node on, as far as parts.nodes has room; items and refs are all there anyway. sorted:
  /// null unless in_order.
  void build(runtime::buffer<Primitive>& primitives, runtime::buffer<std::uint32_t>& starts,
             std::uint32_t subtrees, runtime::buffer<std::uint32_t>& order, tree_parts& parts,
             std::uint32_t first_node, const leaf_triangles* sorted, std::vector<step>& steps);

  /// How many nodes there are then, or would be with more room. Waits for the device.
  std::uint32_t nodes();

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  leaf_rule leaves_;
  bool is_serial_;
  std::uint32_t pieces_;
  runtime::buffer<std::uint32_t> counter_{1};
  runtime::program program_;
  runtime::kernel build_;
};

extern template class bottoms<texel>;
extern template class bottoms<Box>;

}  // namespace facet::tracer
