// The radix tree over sorted codes, merged bottom-up: what makes trees of tree_kind::levels
// (cl/levels.cl, cl/serial_levels.cl).
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/bottoms.hpp"
#include "tracer/leaf_order.hpp"
#include "tracer/leaf_rule.hpp"
#include "tracer/program_set.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// What a tree is merged from: sorted codes, the order that they give, and the subtrees with at
/// most FACET_SWEEP_MOST places (subtrees.hpp), of which there is at least one.
struct sorted_places {
  runtime::buffer<std::uint32_t>&codes, &order, &starts;
  std::uint32_t count, subtrees;
};

/// What is known of a tree when it is built. Where `nodes` are more than there is room for, they
/// are not all written.
struct built_root {
  std::uint32_t nodes, root, depth;
};

/// Primitive is texel (triangles) or Box.
template <class Primitive>
class levels {
 public:
  levels(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
         leaf_rule leaves, bool in_order);

  /// The nodes over subtrees come first, those below them from subtrees - 1 on. sorted: null unless
  /// in_order. Waits for the device.
  built_root build(runtime::buffer<Primitive>& primitives, const sorted_places& places,
                   tree_parts& parts, const leaf_triangles* sorted, std::vector<step>& steps);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  void merge_subtrees(runtime::buffer<Primitive>& primitives, const sorted_places& places,
                      tree_parts& parts, const leaf_triangles* sorted, std::vector<step>& steps);
  void merge_items(const sorted_places& places, tree_parts& parts, std::vector<step>& steps);
  void merge_serially(const sorted_places& places, tree_parts& parts, std::vector<step>& steps);
  std::uint32_t each(std::uint32_t subtrees) const { return (subtrees + pieces_ - 1) / pieces_; }

  runtime::queue queue_;
  bool is_serial_;
  std::uint32_t group_, pieces_;
  runtime::buffer<std::uint32_t> told_{3};  ///< nodes, root, depth
  runtime::buffer<std::uint32_t> ends_{1};  ///< a scratch word an item, or a run of them
  runtime::program program_;
  runtime::kernel subtrees_, items_, loose_;
};

extern template class levels<texel>;
extern template class levels<Box>;

}  // namespace facet::tracer
