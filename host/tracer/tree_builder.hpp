// Binary trees, built on the device: what every layout is made from.
//
// Primitives are sorted along a Morton curve, and the largest subtrees of the radix tree over the
// sorted codes that have at most 32 primitives are found. `levels` keeps that tree (levels.hpp).
// `binned` gives each of these subtrees a tree of its own, by trying every split (cl/sweep.h), and
// builds a tree over their boxes from the root down, by bins (cl/top.cl). So most of the work is
// local, and what is global works on n / 20 items. The tree is the same on every run and device;
// which index a node has is not.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/leaf_order.hpp"
#include "tracer/leaf_rule.hpp"
#include "tracer/node_tree.hpp"
#include "tracer/pack.hpp"
#include "tracer/step.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Primitive is texel (triangles, three corners a row) or Box. Memory is kept from build to build.
template <class Primitive>
class tree_builder {
 public:
  /// kind: not tree_kind::none. in_order: triangles are put into leaf order, too. `kernels` outlive
  /// this.
  tree_builder(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
               tree_kind kind, leaf_rule leaves, bool in_order = false);
  tree_builder(tree_builder&&) noexcept;
  ~tree_builder();

  /// Compiles what trees over so many primitives take beside what all do, which the first of them
  /// does otherwise.
  void prepare(std::uint32_t count);

  /// The tree over the first `count` > 0 primitives; finite ones. Memory that `into` holds is used
  /// again where it is enough. sorted: given if the builder is in_order.
  void build(runtime::buffer<Primitive>& primitives, std::uint32_t count, node_tree& into,
             const leaf_triangles* sorted = nullptr);

  /// Bytes of device memory that a build takes at its peak beside its primitives, what it returns
  /// included.
  static std::uint64_t scratch_bytes(std::uint64_t count);

  /// The commands of the last build.
  const std::vector<step>& steps() const { return steps_; }
  void add_programs(program_set& to) const;

 private:
  struct parts;
  void try_build(runtime::buffer<Primitive>& primitives, std::uint32_t count, node_tree& t,
                 const leaf_triangles* sorted);

  leaf_rule leaves_;
  std::vector<step> steps_;
  std::unique_ptr<parts> parts_;
};

extern template class tree_builder<texel>;
extern template class tree_builder<Box>;

}  // namespace facet::tracer
