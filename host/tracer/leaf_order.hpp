// Puts what belongs to triangles into the order of a tree's leaves.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/pack.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// A mesh's triangles in leaf order: its first one stands in `slot`.
struct leaf_triangles {
  runtime::buffer<std::uint32_t>& materials;  ///< by triangle, in the mesh's order
  runtime::buffer<texel>& corners;
  runtime::buffer<TriangleInfo>& infos;
  std::uint32_t slot;
};

class leaf_order {
 public:
  leaf_order(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// corners_out[3 * (slot + i) ..] and infos[slot + i] are those of the mesh's triangle order[i].
  runtime::event triangles(runtime::buffer<std::uint32_t>& order, runtime::buffer<texel>& corners,
                           std::uint32_t count, const leaf_triangles& to);
  /// The same of normals, three a triangle.
  void normals(runtime::buffer<std::uint32_t>& order, runtime::buffer<texel>& normals,
               runtime::buffer<texel>& normals_out, std::uint32_t count, std::uint32_t slot);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  std::uint32_t group_;
  runtime::program program_;
  runtime::kernel triangles_, normals_;
};

}  // namespace facet::tracer
