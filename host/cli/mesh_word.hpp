// What is traced, as the command line names it: a file, or a generator in a word.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace facet::cli {

/// "bunny.obj", "dragon.ply": one instance of that mesh, as it stands. "scene.json": all its
/// instances. "terrain:1000", "icosphere", "torus_knot:p=3,q=5": a generator; a bare number is the
/// parameter that sets its size (n, subdivisions, depth or divisions, or else its first).
/// The scene is good for tracing rays; its camera and materials may be made up.
/// Throws scene_error.
scene scene_of_word(const std::string& word);

/// The same words as scenes that a picture can be made of: a scene file as it is; of a mesh file
/// and a generator camera, light and material are made up (scene_of_mesh), and the notes say so.
/// Throws scene_error.
scene picture_of_word(const std::string& word);

/// The name of a generator's parameter that a bare number sets; "" if there is no such kind.
std::string size_parameter(const std::string& kind);

}  // namespace facet::cli
