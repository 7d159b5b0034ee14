// Every rule that a scene must keep before it is traced.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace facet {

/// Checks every rule of scene.hpp, material.hpp, mesh.hpp and limits, whoever made the scene:
/// numbers are finite and in range, indices point at what is there, transforms have an inverse,
/// the camera sees somewhere, all world boxes lie within limits::coordinate. One pass over each
/// mesh. Throws scene_error with `file` and a JSON pointer as the place ("/camera/up",
/// "/materials/glass/Ni", "/instances/3/transform"); meshes and materials stand there by their
/// name, or by their index where they have none.
void validate(const scene& s, const std::string& file);

/// Those of them that are about one mesh. It is one of the scene's.
void validate_mesh(const scene& s, std::size_t mesh, const std::string& file);

/// Those of the transform of instance `index`, over a mesh with these bounds.
void validate_transform(const transform& t, const box3f& mesh_bounds, std::size_t index,
                        const std::string& file);

}  // namespace facet
