// Scenes that the tests of tracing share: made in code, small, and each hard in its own way.
#pragma once

#include <string>
#include <vector>

#include "scene/generate.hpp"
#include "scene/scene.hpp"
#include "tracer/pack.hpp"
#include "tracer/random_helper.hpp"
#include "tracer/tracer.hpp"

namespace facet::test {

inline material coloured(std::string name, vec3f kd) {
  material m;
  m.name = std::move(name);
  m.Kd = kd;
  return m;
}

/// One mesh under the identity.
inline scene one_mesh(mesh m) {
  scene s;
  s.materials.push_back(coloured("grey", {0.7f, 0.7f, 0.7f}));
  s.meshes.push_back(std::move(m));
  s.instances.push_back({});
  light l;
  l.position = {3, 4, 5};
  s.lights.push_back(l);
  s.background = {0.1f, 0.2f, 0.3f};
  s.ambient = {0.1f, 0.1f, 0.1f};
  s.view.position = {2.5, 1.5, 3};
  return s;
}

/// As packed: three texels a triangle.
inline std::vector<tracer::texel> corners_of(const mesh& m) {
  std::vector<tracer::texel> corners;
  for (std::uint32_t t = 0; t < m.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) {
      const vec3f p = m.position(t, k);
      corners.push_back({p.x, p.y, p.z, 0});
    }
  return corners;
}

/// Triangles that meet only at random: n of them, of half a unit.
inline mesh random_soup(std::uint32_t n, std::uint64_t seed) {
  random r(seed);
  mesh m;
  for (std::uint32_t i = 0; i < 3 * n; ++i) {
    const vec3f centre = i % 3 == 0 ? r.in_cube() : m.positions[i - i % 3];
    m.positions.push_back(centre + r.in_cube() * 0.25f);
    m.indices.push_back(i);
  }
  return m;
}

/// Rotated, stretched, mirrored, tiny and huge copies of two meshes, one of them smooth.
inline scene many_instances() {
  scene s = one_mesh(generate("icosphere", {{"radius", 0.5}, {"subdivisions", 3}, {"smooth", 1}}));
  s.meshes.push_back(random_soup(200, 7));
  s.instances.clear();
  random r(3);
  for (std::uint32_t k = 0; k < 40; ++k) {
    instance i;
    i.mesh = k % 2;
    const double size = k % 5 == 0 ? 1e-2 : k % 7 == 0 ? 3 : 0.5;
    const vec3d stretch{size, size * 0.5, k % 3 == 0 ? -size : size};
    i.world_from_object = transform::translate(vec3d(r.in_cube() * 2.0f)) *
                          transform::rotate(vec3d(r.in_cube()), 360.0 * r.uniform()) *
                          transform::scale(stretch);
    s.instances.push_back(i);
  }
  return s;
}

/// Every feature at once: glass and a mirror, smooth and flat, several instances, both kinds of
/// light.
inline scene every_feature() {
  scene s = one_mesh(generate("icosphere", {{"radius", 0.6}, {"subdivisions", 3}, {"smooth", 1}}));
  s.meshes.push_back(generate("box", {{"size", 0.8}}));
  s.meshes.push_back(generate("plane", {{"size", 12}, {"divisions", 4}}));
  material glass = coloured("glass", {0.05f, 0.05f, 0.05f});
  glass.Kt = {0.9f, 0.7f, 0.5f};
  glass.Kr = {0.1f, 0.1f, 0.1f};
  glass.Ni = 1.5f;
  glass.attenuation_distance = 0.7f;
  material mirror = coloured("mirror", {0.1f, 0.1f, 0.1f});
  mirror.Kr = {0.8f, 0.8f, 0.8f};
  mirror.Ks = {0.5f, 0.5f, 0.5f};
  mirror.Ns = 60;
  s.materials.push_back(glass);
  s.materials.push_back(mirror);
  s.instances.clear();
  const auto place = [&](std::uint32_t mesh, std::uint32_t material, const transform& t) {
    s.instances.push_back({mesh, t, material});
  };
  place(2, 0, transform::translate({0, -0.7, 0}));
  place(0, 1, transform{});
  place(0, 2, transform::translate({-1.4, 0, -0.5}));
  place(1, 0, transform::translate({1.3, -0.1, -0.8}) * transform::rotate({0, 1, 0}, 30));
  place(1, 1, transform::translate({0.9, -0.1, 0.9}) * transform::scale({0.8, 1, 0.3}));
  light sun;
  sun.type = light::kind::directional;
  sun.direction = {-1, -2, -0.5};
  sun.colour = {0.4f, 0.4f, 0.35f};
  s.lights.push_back(sun);
  s.width = 96;
  s.height = 64;
  return s;
}

/// Rays from around the scene into it, with ones along axes and ones from inside among them.
inline std::vector<tracer::ray> random_rays(std::size_t n, std::uint64_t seed, float size = 1) {
  random r(seed);
  std::vector<tracer::ray> rays;
  for (std::size_t i = 0; i < n; ++i) {
    vec3f o = r.in_cube() * (i % 4 == 0 ? size : 3 * size);
    vec3f d = r.in_cube() * size - o;
    if (i % 16 == 1) d = {0, 0, d.z < 0 ? -1.0f : 1.0f};
    if (i % 16 == 2) d = {d.x, -0.0f, d.z};
    rays.push_back({{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, i % 8 == 3 ? 0.7f : INFINITY});
  }
  return rays;
}

}  // namespace facet::test
