// Vertices that a mesh is to move to: whether it may.
#pragma once

#include <cstdint>
#include <span>

#include "scene/scene.hpp"

namespace facet::tracer {

/// Whether the mesh's triangles use all its positions.
bool uses_all_positions(const mesh& m);

/// The bounds that the scene's mesh will have with these positions, as many as it has, and these
/// normals, or its own if there are none; it is as before when this returns. Throws scene_error for
/// what validate_mesh does not allow. One pass over them if `uses_all`, and two over the triangles
/// otherwise.
box3f checked_bounds(scene& s, std::uint32_t mesh, std::span<const vec3f> positions,
                     std::span<const vec3f> normals, bool uses_all);

}  // namespace facet::tracer
