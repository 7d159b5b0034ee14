// A mesh's vertices on the device, and its triangles' corners and normals made from them
// (cl/moved_corners.cl).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/runtime.hpp"
#include "scene/mesh.hpp"
#include "tracer/kernels.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tree.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Of one mesh. Device memory is taken for what is used: normals may never be.
struct mesh_vertices {
  /// Positions and normals are left undefined.
  explicit mesh_vertices(const mesh& m);

  runtime::buffer<std::uint32_t> indices, normal_indices;  ///< three a triangle
  runtime::buffer<vec3f> positions, normals;
};

class corner_mover {
 public:
  corner_mover(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
               bool is_wide);

  /// Writes the mesh's corners into their slots of `to`, as device_geometry has them, from
  /// v.positions; those that `shut` (one entry a triangle, or none: none is) names as points.
  /// Without `shut` those whose area is in doubt are listed. Nothing is waited for.
  void write(const mesh_vertices& v, const device_geometry& g, const mesh_place& at,
             const std::vector<bool>& shut, const runtime::buffer<texel>& to);

  /// Triangles of the last `write` without `shut` that may have no area; empty if there are too
  /// many to list. Waits for it.
  std::optional<std::vector<std::uint32_t>> unsure();

  /// Writes three normals a slot from v.normals. Nothing is waited for.
  void write_normals(const mesh_vertices& v, const device_geometry& g, const mesh_place& at,
                     const runtime::buffer<texel>& to);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  bool is_wide_;
  std::uint32_t group_, run_;
  runtime::program program_;
  runtime::kernel move_, move_normals_;
  runtime::buffer<std::uint32_t> unsure_;
  runtime::buffer<std::uint32_t> none_{1};  ///< in place of bits, where none is shut
};

}  // namespace facet::tracer
