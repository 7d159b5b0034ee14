// Binary trees, built on the device: what every layout is made from.
//
// Primitives are sorted along a Morton curve. The largest subtrees of the radix tree over the
// sorted codes that have at most 32 primitives get a tree each, by trying every split (cl/sweep.h);
// over these subtrees' boxes a tree is built from the root down, by bins (cl/top.cl). So most of
// the work is local, and what is global works on n / 20 items. The tree is the same on every run
// and device; which index a node has is not.
#pragma once

#include <cstdint>
#include <memory>

#include "runtime/runtime.hpp"
#include "tracer/bottoms.hpp"
#include "tracer/morton.hpp"
#include "tracer/radix_sort.hpp"

namespace facet::tracer {

/// A child's index is larger than its parent's. `nodes` may have room for more than `node_count`.
struct device_tree {
  runtime::buffer<Node> nodes{1};
  runtime::buffer<std::uint32_t> order{1};  ///< leaf place -> primitive, 1 a primitive
  std::uint32_t root = FACET_NONE;          ///< as a child
  std::uint32_t node_count = 0;
  std::uint32_t depth = 0;  ///< nodes on the longest way down
};

/// Primitive is texel (triangles, three corners a row) or Box. Memory is kept from build to build.
template <class Primitive>
class tree_builder {
 public:
  tree_builder(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
               leaf_rule leaves);
  ~tree_builder();

  /// The tree over the first `count` > 0 primitives; finite ones. Memory that `into` holds is used
  /// again where it is enough.
  void build(runtime::buffer<Primitive>& primitives, std::uint32_t count, device_tree& into);

  /// Bytes of device memory that a build takes at its peak beside its primitives, what it returns
  /// included.
  static std::uint64_t scratch_bytes(std::uint64_t count, const tuning& t);

  /// The commands of the last build.
  const std::vector<sort_step>& steps() const { return steps_; }
  double compile_ms() const;

 private:
  struct parts;
  void try_build(runtime::buffer<Primitive>& primitives, std::uint32_t count, device_tree& t);

  leaf_rule leaves_;
  std::vector<sort_step> steps_;
  std::unique_ptr<parts> parts_;
};

extern template class tree_builder<texel>;
extern template class tree_builder<Box>;

}  // namespace facet::tracer
