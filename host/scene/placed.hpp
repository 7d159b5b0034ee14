// A scene whose meshes stand in the world already: what does not move, and is not shown often,
// needs no transform while rays are traced.
#pragma once

#include <cstdint>

#include "scene/scene.hpp"

namespace facet {

namespace limits {
inline constexpr std::uint64_t placed_triangles = 1u << 20;  ///< always few enough to be placed
inline constexpr std::uint64_t placed_copies = 2;  ///< of all triangles, on average, beyond that
inline constexpr double placed_distance = 64;      ///< in sides of an instance's world box
}  // namespace limits

/// The same picture's scene with one mesh and one instance, at rest: triangles in the order of
/// instances and, within each, of its mesh, so that of equal hits the same one is kept. Corners are
/// mapped in double and rounded to float once; normals by the inverse transpose. A mirrored
/// instance's triangles are turned, so that their front stays in front.
///
/// It is as it was, `s` itself, where that would cost more than it gains: where instances show more
/// than `placed_triangles` and more than `placed_copies` times what the meshes have, or where one
/// is farther from the origin than `placed_distance` times its size, so that rounding its corners
/// would show.
scene placed(scene s);

}  // namespace facet
