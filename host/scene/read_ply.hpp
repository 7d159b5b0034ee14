// Stanford PLY, ascii and binary of either byte order.
#pragma once

#include <filesystem>

#include "scene/mesh_file.hpp"

namespace facet {

/// Reads vertices (x, y, z, and nx, ny, nz if all three are there) and faces (vertex_indices or
/// vertex_index; polygons become fans); other elements and properties are passed over. The file has
/// no materials.
///
/// Throws scene_error with the place ("line 3" of the header, "vertex 12", "face 7", counted from
/// 0 as the format counts) for a malformed or truncated file, a count that the file is too small to
/// hold, or an index out of range; and without a place if no triangle is left.
mesh_file read_ply(const std::filesystem::path& path);

}  // namespace facet
