// Scene files: JSON, in the terms of scenes/facet-scene.schema.json.
#pragma once

#include <filesystem>

#include "scene/scene.hpp"

namespace facet {

/// Reads a scene file and the mesh files that it names; the result is valid (validate.hpp).
///
/// Every key is known (scene_terms.hpp) and every number is finite. What is left out takes the
/// default of its member in scene.hpp and material.hpp; a scene without "camera" gets one that
/// frames it. Materials are kept in the order of their names. A mesh that names no material has
/// the one named "default", or material's own defaults if the scene has none of that name.
/// Mesh files are found relative to the scene's folder and must lie within it.
///
/// Throws scene_error; where it is about the scene file, the place is a JSON pointer, or a line
/// and a column if the file is not JSON.
scene read_json(const std::filesystem::path& path);

}  // namespace facet
