// A triangle mesh in its own coordinates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/vec.hpp"

namespace facet {

/// Triangles wind counter-clockwise seen from outside. Indices are valid and positions finite and
/// at most `limits::coordinate` in size: every reader and generator guarantees it (validate.hpp).
struct mesh {
  std::string name;
  std::vector<vec3f> positions;
  std::vector<std::uint32_t> indices;  ///< 3 a triangle, into positions

  std::vector<vec3f> normals;                 ///< unit; empty if the mesh is flat
  std::vector<std::uint32_t> normal_indices;  ///< 3 a triangle, into normals; empty if flat

  std::vector<std::uint32_t> materials;  ///< 1 a triangle, into scene::materials; empty: all 0

  /// Index in the file, after fan triangulation, of each triangle; empty if nothing was dropped.
  std::vector<std::uint32_t> source;
  std::size_t dropped = 0;  ///< triangles of the file left out for coordinates that are not finite

  std::size_t triangle_count() const { return indices.size() / 3; }
  bool is_smooth() const { return !normal_indices.empty(); }
  std::uint32_t material_of(std::size_t triangle) const {
    return materials.empty() ? 0 : materials[triangle];
  }
  std::uint32_t source_of(std::size_t triangle) const {
    return source.empty() ? std::uint32_t(triangle) : source[triangle];
  }
  vec3f position(std::size_t triangle, int corner) const {
    return positions[indices[3 * triangle + std::size_t(corner)]];
  }
  vec3f normal(std::size_t triangle, int corner) const {
    return normals[normal_indices[3 * triangle + std::size_t(corner)]];
  }
  box3f bounds() const {
    box3f b;
    for (std::uint32_t i : indices) b.add(positions[i]);
    return b;
  }
};

}  // namespace facet
