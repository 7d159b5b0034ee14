// Scenes and rays that the tests of the reference share.
#pragma once

#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "reference/tracer.hpp"
#include "scene/generate.hpp"
#include "scene/scene.hpp"
#include "tracer/random_helper.hpp"

namespace facet::test {

inline mesh mesh_of(std::vector<vec3f> positions, std::vector<std::uint32_t> indices) {
  mesh m;
  m.positions = std::move(positions);
  m.indices = std::move(indices);
  return m;
}

/// Counter-clockwise seen from +z.
inline mesh unit_triangle() { return mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}); }

/// A rectangle from two triangles, counter-clockwise seen from where u x v points.
inline mesh rectangle(vec3f centre, vec3f u, vec3f v) {
  return mesh_of({centre - u - v, centre + u - v, centre + u + v, centre - u + v},
                 {0, 1, 2, 0, 2, 3});
}

/// Black but for what a test sets.
inline material black() {
  material m;
  m.Kd = {0, 0, 0};
  return m;
}
inline material glowing(vec3f Ke) {
  material m = black();
  m.Ke = Ke;
  return m;
}
inline material clear(float Ni) {
  material m = black();
  m.Kt = {1, 1, 1};
  m.Ni = Ni;
  return m;
}

/// Adds a mesh with a material of its own, once.
inline std::uint32_t add(scene& s, mesh m, material look, transform where = {}) {
  s.materials.push_back(std::move(look));
  s.meshes.push_back(std::move(m));
  s.instances.push_back(
      {std::uint32_t(s.meshes.size() - 1), where, std::uint32_t(s.materials.size() - 1)});
  return std::uint32_t(s.materials.size() - 1);
}

inline scene scene_of(mesh m, transform where = {}) {
  scene s;
  add(s, std::move(m), material{}, where);
  return s;
}

/// What the eye sees from `origin` along `direction`.
template <class T>
vec3<T> seen(const scene& s, vec3d origin, vec3d direction, std::uint32_t depth = 8) {
  const reference::film<T> film(camera_frame{origin, direction, {}, {}});
  const auto c = reference::tracer<T>(s).pixel(film, 0, 0, depth);
  return {c[0], c[1], c[2]};
}

/// Random triangles of up to half a unit around the unit cube.
inline mesh soup_of(std::uint32_t n, std::uint64_t seed) {
  random r(seed);
  mesh m;
  for (std::uint32_t i = 0; i < 3 * n; ++i) {
    const vec3f centre = i % 3 == 0 ? r.in_cube() : m.positions[i - i % 3];
    m.positions.push_back(centre + r.in_cube() * 0.25f);
    m.indices.push_back(i);
  }
  return m;
}

/// Copies of a soup, a closed mesh and an empty one: turned, stretched, mirrored, tiny, huge.
inline scene crowd() {
  scene s;
  s.materials.emplace_back();
  s.meshes = {soup_of(60, 7), generate("noisy_sphere", {{"subdivisions", 2}, {"radius", 0.5}}), {}};
  random r(3);
  for (std::uint32_t k = 0; k < 30; ++k) {
    const double size = k % 5 == 0 ? 1e-2 : k % 7 == 0 ? 3 : 0.5;
    instance i;
    i.mesh = k % 8 == 7 ? 2 : k % 2;
    if (k > 0)
      i.world_from_object = transform::translate(vec3d(r.in_cube() * 2.0f)) *
                            transform::rotate(vec3d(r.in_cube()), 360.0 * double(r.uniform())) *
                            transform::scale({size, size * 0.5, k % 3 == 0 ? -size : size});
    s.instances.push_back(i);
  }
  return s;
}

/// Rays into the cube of the given half side: along axes, from inside, short and long among them.
template <class T>
std::vector<reference::ray<T>> rays_into(T size, std::size_t n, std::uint64_t seed) {
  random r(seed);
  std::vector<reference::ray<T>> rays;
  for (std::size_t i = 0; i < n; ++i) {
    const vec3<T> o = vec3<T>(r.in_cube()) * (i % 4 == 0 ? size : 3 * size);
    vec3<T> d = vec3<T>(r.in_cube()) * size - o;
    if (i % 16 == 1) d = {0, 0, d.z < 0 ? T(-1) : T(1)};
    if (i % 16 == 2) d = {d.x, T(-0.0), d.z};
    rays.push_back({o, i % 8 == 5 ? T(0.25) : T(0), d, i % 8 == 3 ? T(0.7) : INFINITY});
  }
  return rays;
}

}  // namespace facet::test
