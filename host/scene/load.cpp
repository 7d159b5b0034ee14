#include "scene/load.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include "scene/error.hpp"
#include "scene/framing.hpp"
#include "scene/nearest.hpp"
#include "scene/read_json.hpp"
#include "scene/read_ply.hpp"
#include "scene/validate.hpp"
#include "scene/world_bounds.hpp"

namespace facet {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return extension;
}

}  // namespace

bool is_mesh_file(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".obj" || extension == ".ply";
}

mesh_file read_mesh_file(const std::filesystem::path& path) {
  if (!is_mesh_file(path))
    throw scene_error(path.string(), "", "is not a mesh file; these end in .obj or .ply");
  return extension_of(path) == ".obj" ? read_obj(path) : read_ply(path);
}

scene scene_of_mesh(mesh_file file, const std::string& name) {
  scene s;
  s.name = name;
  s.notes = std::move(file.notes);
  s.materials = std::move(file.materials);
  if (s.materials.empty()) {
    material grey;
    grey.name = "default";
    grey.Ka = grey.Kd;
    s.materials.push_back(grey);
    s.notes.emplace_back("the mesh brings no material: a grey one was made up");
  }
  s.meshes.push_back(std::move(file.mesh));
  if (s.meshes[0].name.empty()) s.meshes[0].name = name;
  s.instances.push_back({});
  s.view = camera_that_frames(world_box<double>(s));
  s.lights.push_back(key_light_for(s.view));
  s.ambient = {0.15f, 0.15f, 0.15f};
  s.background = {0.18f, 0.2f, 0.24f};
  s.notes.emplace_back(
      "a mesh alone: a camera that frames it (y up, from the right, slightly raised), one "
      "directional light from above its left shoulder, a little ambient light and a grey-blue "
      "background were made up");
  return s;
}

scene load_scene(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".json") return read_json(path);
  if (!is_mesh_file(path))
    throw scene_error(path.string(), "",
                      (extension.empty() ? "has no extension" : "ends in " + in_quotes(extension)) +
                          "; a scene is a .json file, or a mesh alone, an .obj or .ply file");
  scene s = scene_of_mesh(read_mesh_file(path), path.stem().string());
  validate(s, path.string());
  return s;
}

}  // namespace facet
