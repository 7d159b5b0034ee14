// Scenes and meshes from files, by what the file is called.
#pragma once

#include <filesystem>
#include <string>

#include "scene/read_obj.hpp"
#include "scene/scene.hpp"

namespace facet {

/// Loads a scene by its extension, whatever its case: .json (read_json.hpp), .obj or .ply (a mesh
/// alone, scene_of_mesh). The result is valid. Throws scene_error; for another extension it says
/// which are allowed.
scene load_scene(const std::filesystem::path& path);

/// Is it called .obj or .ply?
bool is_mesh_file(const std::filesystem::path& path);

/// Reads a .obj or a .ply. Throws scene_error.
mesh_file read_mesh_file(const std::filesystem::path& path);

/// A scene of one mesh as it stands, y up. Made up, and told in the notes: a camera that frames
/// it, a directional key light, a modest ambient and background, and a grey material if it brings
/// none.
scene scene_of_mesh(mesh_file file, const std::string& name);

}  // namespace facet
