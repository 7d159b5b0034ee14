#include "study/cases/glass_scenes.hpp"

#include <array>
#include <cmath>

#include "scene/generate.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

// The outer slab fills 0 < z < 4, the inner one 1 < z < 3; both are so wide that no ray of a
// picture meets their sides, and no wider: rays leave a face by a bound that grows with the size of
// its triangles, and ways inside are shorter by that. Eyes look along +z.
constexpr double outer_near = 0, outer_far = 4, inner_near = 1, inner_far = 3;
enum : std::uint32_t { wall, outer, inner };

mesh slab(double near, double far, double half) {
  mesh m = generate("box", {{"size", 2}});
  for (vec3f& p : m.positions) p = vec3f(vec3d(p.x * half, p.y * half, p.z < 0 ? near : far));
  return m;
}

mesh square(double z, double half) {
  mesh m;
  const auto at = [&](double x, double y) { return vec3f(vec3d(x * half, y * half, z)); };
  add_loose(m, at(-1, -1), at(1, 1), at(1, -1));
  add_loose(m, at(-1, -1), at(-1, 1), at(1, 1));
  return m;
}

/// The two slabs, the wall at wall_z, and an eye at eye_z.
scene slabs(double eye_z, double wall_z) {
  scene s = scene_with(square(wall_z, 10));
  s.materials[0].Kd = {0, 0, 0};
  for (const auto& [name, index, kt, distance] :
       {std::tuple("outer", 1.5f, vec3f(0.9f, 0.8f, 0.7f), 3.0f),
        std::tuple("inner", 1.2f, vec3f(0.6f, 0.95f, 0.85f), 1.5f)}) {
    material m;
    m.name = name;
    m.Kd = {0, 0, 0};
    m.Kt = kt;
    m.Ni = index;
    m.has_attenuation = true;
    m.attenuation = {0.5f, 0.8f, 0.9f};
    m.attenuation_distance = distance;
    s.materials.push_back(m);
  }
  s.meshes.push_back(slab(outer_near, outer_far, 8));
  s.meshes.push_back(slab(inner_near, inner_far, 7));
  s.instances.push_back({1, {}, outer});
  s.instances.push_back({2, {}, inner});
  s.nesting = 2;
  s.view.position = {0, 0, eye_z};
  s.view.look_at = {0, 0, eye_z + 1};
  return s;
}

/// How much of from..to lies in near..far.
double overlap(double from, double to, double near, double far) {
  if (from > to) std::swap(from, to);
  return std::max(0.0, std::min(to, far) - std::max(from, near));
}

/// What passes straight from z = from to z = to, the way being `stretch` times as long.
vec3d straight(const scene& s, double from, double to, double stretch) {
  vec3d t(1, 1, 1);
  for (const auto& [k, near, far] :
       {std::tuple(outer, outer_near, outer_far), std::tuple(inner, inner_near, inner_far)}) {
    const material& m = s.materials[k];
    const int crossings = (std::min(from, to) < near && near < std::max(from, to)) +
                          (std::min(from, to) < far && far < std::max(from, to));
    const vec3d sigma = m.absorption();
    for (int c = 0; c < 3; ++c)
      t[c] *= std::pow(double(m.Kt[c]), crossings) *
              std::exp(-sigma[c] * overlap(from, to, near, far) * stretch);
  }
  return t;
}

bool lies_in(double z, double near, double far) { return near < z && z < far; }

double index_at(const scene& s, double z) {
  return lies_in(z, inner_near, inner_far)   ? double(s.materials[inner].Ni)
         : lies_in(z, outer_near, outer_far) ? double(s.materials[outer].Ni)
                                             : 1;
}

/// Bent at each face: the sine times the index stays what it is at the eye.
vec3d seen_through(const scene& s, vec3d way) {
  const double eye = s.view.position.z, end = double(s.meshes[0].positions[0].z);
  const double invariant = std::hypot(way.x, way.y) * index_at(s, eye);
  vec3d seen(s.materials[wall].Ke);
  double from = eye;
  for (const double face : {outer_near, inner_near, inner_far, outer_far, end}) {
    if (face <= eye) continue;
    const double sine = invariant / index_at(s, (from + face) / 2);
    seen = seen * straight(s, from, face, 1 / std::sqrt(1 - sine * sine));
    // The faces themselves: straight() counts those strictly between its ends.
    if (face < end) {
      const std::uint32_t k = face == outer_near || face == outer_far ? outer : inner;
      seen = seen * vec3d(s.materials[k].Kt);
    }
    from = face;
  }
  return seen;
}

/// The light of all lamps from the wall, and the way from there to the eye, which is straight.
vec3d lit_wall(const scene& s, vec3d way) {
  const double eye = s.view.position.z, end = double(s.meshes[0].positions[0].z);
  const vec3d p = s.view.position + way * ((end - eye) / way.z);
  vec3d sum;
  for (const light& lamp : s.lights) {
    const bool is_point = lamp.type == light::kind::point;
    const vec3d to = is_point ? lamp.position - p : -lamp.direction;
    const vec3d l = normalize(to);
    const double behind = is_point ? lamp.position.z : -100;
    sum = sum + vec3d(lamp.colour) * straight(s, end, behind, 1 / std::abs(l.z)) *
                    vec3d(s.materials[wall].Kd) * std::abs(l.z);
  }
  return sum * straight(s, eye, end, 1 / way.z);
}

scene through(double eye_z) {
  scene s = slabs(eye_z, 6);
  s.materials[wall].Ke = {1, 0.9f, 0.8f};
  return s;
}

scene from_outside() { return through(-2); }
scene from_outer() { return through(0.5); }
scene from_inner() { return through(2); }

scene lamp_inside() {
  scene s = slabs(5, 6);
  s.materials[wall].Kd = {0.9f, 0.8f, 0.7f};
  light lamp;
  lamp.position = {0.3, 0.2, 2};
  s.lights.push_back(lamp);
  return s;
}

scene all_inside() {
  scene s = slabs(3.2, 3.5);
  s.materials[wall].Kd = {0.9f, 0.8f, 0.7f};
  light lamp, sun;
  lamp.position = {0.3, 0.2, 2};
  sun.type = light::kind::directional;
  sun.direction = {0.3, -0.2, 1};
  s.lights = {lamp, sun};
  return s;
}

constexpr std::array<glass_scene, 5> scenes{{
    {"eye outside", from_outside, seen_through},
    {"eye in the outer", from_outer, seen_through},
    {"eye in the inner", from_inner, seen_through},
    {"lamp in the inner", lamp_inside, lit_wall},
    {"eye, wall and lamp inside, and a sun outside", all_inside, lit_wall},
}};

/// A convex polygon of a convex mesh around the origin, as a fan that is counter-clockwise from
/// outside.
void add_polygon(mesh& m, std::vector<vec3f> p) {
  if (dot(cross(p[1] - p[0], p[2] - p[0]), p[0]) < 0) std::reverse(p.begin(), p.end());
  const auto index = [&](vec3f q) {
    const auto at = std::find(m.positions.begin(), m.positions.end(), q);
    if (at != m.positions.end()) return std::uint32_t(at - m.positions.begin());
    m.positions.push_back(q);
    return std::uint32_t(m.positions.size() - 1);
  };
  for (std::size_t k = 2; k < p.size(); ++k)
    for (const vec3f& q : {p[0], p[k - 1], p[k]}) m.indices.push_back(index(q));
}

}  // namespace

std::span<const glass_scene> glass_scenes() { return scenes; }

mesh bevelled_box(float half, float bevel) {
  mesh m;
  const float cut = half - bevel;
  // The corner of the face across `axis` at the corner of the box in direction (x, y, z).
  const auto corner = [&](int axis, float x, float y, float z) {
    vec3f p(x * cut, y * cut, z * cut);
    p[axis] = p[axis] > 0 ? half : -half;
    return p;
  };
  const auto along = [&](int axis, int other, float a, float b, float c) {
    // The corner at a on `axis`, b on the next one, c on the last.
    vec3f sign;
    sign[axis] = a, sign[(axis + 1) % 3] = b, sign[(axis + 2) % 3] = c;
    return corner(other, sign.x, sign.y, sign.z);
  };
  constexpr std::array<float, 2> signs{-1, 1};
  for (int axis = 0; axis < 3; ++axis)
    for (const float a : signs) {
      add_polygon(m, {along(axis, axis, a, -1, -1), along(axis, axis, a, 1, -1),
                      along(axis, axis, a, 1, 1), along(axis, axis, a, -1, 1)});
      // The edge where the faces across `axis` and the next meet, and one corner in four.
      for (const float b : signs) {
        const int next = (axis + 1) % 3;
        add_polygon(m, {along(axis, axis, a, b, -1), along(axis, axis, a, b, 1),
                        along(axis, next, a, b, 1), along(axis, next, a, b, -1)});
        for (const float c : signs)
          if (axis == 0)
            add_polygon(m, {corner(0, a, b, c), corner(1, a, b, c), corner(2, a, b, c)});
      }
    }
  return m;
}

}  // namespace facet::study
