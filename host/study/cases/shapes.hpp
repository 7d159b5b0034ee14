// Scenes that several cases share.
#pragma once

#include <cmath>

#include "scene/generate.hpp"
#include "scene/scene.hpp"

namespace facet::study {

/// One mesh under the identity, grey and opaque.
inline scene scene_with(mesh m) {
  scene s;
  material grey;
  grey.name = "grey";
  s.materials.push_back(grey);
  s.meshes.push_back(std::move(m));
  s.instances.push_back({});
  return s;
}

/// Each coordinate times `scale`, rounded to a multiple of `step`.
inline mesh on_grid(mesh m, double scale, double step) {
  for (vec3f& p : m.positions)
    for (int i = 0; i < 3; ++i) p[i] = float(std::rint(double(p[i]) * scale / step) * step);
  return m;
}

inline mesh noisy_sphere(int subdivisions) {
  return generate("noisy_sphere", {{"subdivisions", double(subdivisions)}});
}

/// A mesh of loose triangles.
inline void add_loose(mesh& m, vec3f a, vec3f b, vec3f c) {
  const auto first = std::uint32_t(m.positions.size());
  m.positions.insert(m.positions.end(), {a, b, c});
  m.indices.insert(m.indices.end(), {first, first + 1, first + 2});
}

}  // namespace facet::study
