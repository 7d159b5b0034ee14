// The keys of a scene file, object by object; scenes/facet-scene.schema.json publishes the same.
#pragma once

#include <string>
#include <vector>

namespace facet {

struct scene_term {
  std::string object;  ///< the name of its definition in the schema
  std::vector<std::string> keys;
};

/// Each kind of object that a scene file may hold. A generated mesh also takes the parameters of
/// its generator (generate.hpp).
inline const std::vector<scene_term>& scene_terms() {
  static const std::vector<scene_term> terms{
      {"scene",
       {"$schema", "about", "camera", "picture", "ambient", "background", "nesting", "materials",
        "meshes", "instances", "lights"}},
      {"camera", {"position", "look_at", "up", "vertical_fov"}},
      {"picture", {"width", "height", "max_depth", "samples"}},
      {"material",
       {"Ke", "Ka", "Kd", "Ks", "Ns", "Kr", "Kt", "Ni", "attenuation", "attenuation_distance"}},
      {"file_mesh", {"file", "material", "materials", "material_pattern"}},
      {"generated_mesh", {"generate", "material", "materials", "material_pattern"}},
      {"instance", {"mesh", "material", "transform"}},
      {"matrix", {"matrix"}},
      {"step", {"translate", "rotate", "scale"}},
      {"rotation", {"axis", "degrees"}},
      {"point_light", {"type", "position", "colour", "attenuation"}},
      {"directional_light", {"type", "direction", "colour"}},
  };
  return terms;
}

/// The keys of one of them.
inline const std::vector<std::string>& scene_keys(const std::string& object) {
  for (const scene_term& term : scene_terms())
    if (term.object == object) return term.keys;
  static const std::vector<std::string> none;
  return none;
}

}  // namespace facet
