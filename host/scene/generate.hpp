// Meshes from a few words, so that the size of a scene is a parameter.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/mesh.hpp"

namespace facet {

using generator_parameters = std::map<std::string, double>;

struct generator_info {
  struct parameter {
    std::string name;
    double fallback, least, most;  ///< the value if absent, and what is allowed, ends included
    bool whole;                    ///< whole numbers only
    std::string about;
  };
  std::string kind;
  std::vector<parameter> parameters;
  std::string about;
};

/// Every kind, in a fixed order.
const std::vector<generator_info>& generators();

/// The mesh of that kind; deterministic, on every machine with the same maths library. What is not
/// in `p` takes its fallback. mesh.materials is empty but for "room", where it holds the wall.
///
/// Throws scene_error with an empty file and the parameter's name as place: an unknown kind or
/// parameter (the message names the nearest known), a value out of its limits, or more than
/// limits::triangles triangles, which is checked before anything is allocated.
mesh generate(const std::string& kind, const generator_parameters& p);

}  // namespace facet
