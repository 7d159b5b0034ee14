// Wavefront OBJ: triangles, polygons, normals and material names.
#pragma once

#include <filesystem>

#include "scene/mesh_file.hpp"

namespace facet {

/// Reads v, vn, f, usemtl and mtllib; texture coordinates, groups, smoothing groups, lines and
/// points are passed over. Triangle i is the i-th after each polygon became a fan around its first
/// corner. Material files must lie in the folder of the OBJ file or below it; one that does not, or
/// is not there, gives a note. `materials` holds what they define, in their order; then, with a
/// note, a default material for each name that is used but not defined, and one named "default" if
/// faces come before the first usemtl of a file that has materials.
///
/// Throws scene_error with the line for an index that names nothing, and without one if the file
/// cannot be read or no triangle is left.
mesh_file read_obj(const std::filesystem::path& path);

}  // namespace facet
