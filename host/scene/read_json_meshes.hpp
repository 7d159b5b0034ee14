// The "meshes" of a scene file: from mesh files and from generators.
#pragma once

#include <filesystem>

#include "scene/json_reader.hpp"
#include "scene/name_table.hpp"
#include "scene/scene.hpp"

namespace facet {

/// The material of what names none: the scene's "default", or one that is made up once and cannot
/// be named.
std::uint32_t default_material(scene& s, const name_table& materials);

/// Loads every mesh of the object `node` into `s`, each once, and adds its name to `meshes`.
/// Mesh files must lie in `folder`, symbolic links resolved; their materials join the scene's as
/// "MESH.NAME", unless the scene has one of the same NAME, which then takes its place.
///
/// A mesh has as many slots for materials as its file has materials, or as its generator says (1
/// for most). At most one of these keys fills them: "material" (one for all), "materials" (one a
/// slot), "material_pattern" (triangle i takes the i-th name, over and over).
void read_meshes(const json_node& node, const std::filesystem::path& folder,
                 const name_table& materials, name_table& meshes, scene& s);

}  // namespace facet
