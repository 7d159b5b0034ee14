// Trees over the subtrees that tracer/subtrees.hpp lists (cl/bottom.cl, cl/serial_tree.cl).
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/leaf_rule.hpp"
#include "tracer/pack.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// What the top tree is built over, and where nodes go.
struct tree_parts {
  runtime::buffer<Node> nodes;
  runtime::buffer<Item> items;
  runtime::buffer<std::uint32_t> refs;  ///< what each item is as a node's child
};

/// Primitive is texel (triangles) or Box.
template <class Primitive>
class bottoms {
 public:
  bottoms(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
          leaf_rule leaves);

  /// order: sorted place -> primitive; becomes leaf place -> primitive. Nodes are appended from
  /// first_node on. Returns the nodes that there are then; where they are more than
  /// parts.nodes.size() they are not all written. Waits for the device.
  std::uint32_t build(runtime::buffer<Primitive>& primitives,
                      runtime::buffer<std::uint32_t>& starts, std::uint32_t subtrees,
                      runtime::buffer<std::uint32_t>& order, tree_parts& parts,
                      std::uint32_t first_node, std::vector<step>& steps);

  double compile_ms() const { return program_.build_ms(); }

  static std::string options(const tuning& t, leaf_rule leaves);

 private:
  runtime::queue queue_;
  bool is_serial_;
  std::uint32_t pieces_;
  runtime::buffer<std::uint32_t> counter_{1};
  runtime::program program_;
  runtime::kernel build_;
};

extern template class bottoms<texel>;
extern template class bottoms<Box>;

}  // namespace facet::tracer
