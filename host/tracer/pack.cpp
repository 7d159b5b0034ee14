#include "tracer/pack.hpp"

#include <algorithm>
#include <cmath>

#include "scene/shut.hpp"
#include "scene/world_bounds.hpp"

namespace facet::tracer {
namespace {

template <class T>
void put(float (&to)[3], const vec3<T>& from) {
  to[0] = float(from.x), to[1] = float(from.y), to[2] = float(from.z);
}

texel texel_of(vec3f v) { return {v.x, v.y, v.z, 0}; }

void put(float (&to)[12], const transform& from) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j) to[4 * i + j] = float(from.row[i][j]);
}

Material pack_material(const material& m) {
  Material p{};
  put(p.Ke, m.Ke), put(p.Ka, m.Ka), put(p.Kd, m.Kd), put(p.Ks, m.Ks), put(p.Kr, m.Kr),
      put(p.Kt, m.Kt);
  p.Ns = m.Ns;
  p.Ni = m.Ni;
  p.transparent = m.is_transparent();
  p.specular = m.Ks.x > 0 || m.Ks.y > 0 || m.Ks.z > 0;
  if (m.is_transparent()) {
    put(p.sigma, m.absorption());
    for (int c = 0; c < 3; ++c)
      p.minus_ln_Kt[c] = float(-std::log(std::max(double(m.Kt[c]), 1e-30)));
  }
  return p;
}

Light pack_light(const light& l) {
  Light p{};
  if (l.type == light::kind::point) {
    p.kind = FACET_POINT_LIGHT;
    put(p.position, l.position);
  } else {
    p.kind = FACET_DIRECTIONAL_LIGHT;
    put(p.position, -normalize(l.direction));
  }
  put(p.colour, l.colour);
  p.falloff[0] = l.constant, p.falloff[1] = l.linear, p.falloff[2] = l.quadratic;
  return p;
}

void pack_mesh(const mesh& m, bool with_normals, packed_scene& to) {
  const std::vector<bool> is_shut = shut_triangles(m);
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    // As a point a triangle is never met, and keeps its index.
    for (int c = 0; c < 3; ++c) to.corners.push_back(texel_of(m.position(t, is_shut[t] ? 0 : c)));
    if (with_normals)
      for (int c = 0; c < 3; ++c)
        to.normals.push_back(m.is_smooth() ? texel_of(m.normal(t, c)) : texel{});
    to.triangle_materials.push_back(m.material_of(t));
  }
}

}  // namespace

std::array<float, 3> reach_of(const box3f& b) {
  if (b.empty()) return {};
  const vec3f r = max(abs(b.lo), abs(b.hi));
  return {r.x, r.y, r.z};
}

Instance pack_instance(const instance& placed, std::uint32_t id, const box3f& mesh_bounds) {
  Instance q{};
  put(q.world_from_object, placed.world_from_object);
  put(q.object_from_world, placed.world_from_object.inverse());
  const box3f box = world_box<float>(placed.world_from_object, mesh_bounds);
  put(q.lo, box.lo), put(q.hi, box.hi);
  const std::array<float, 3> reach = reach_of(mesh_bounds);
  std::copy(reach.begin(), reach.end(), q.reach);
  q.id = id;
  q.material = placed.material;
  return q;
}

packed_scene pack(const scene& s, bool with_normals) {
  packed_scene p;
  std::vector<bool> is_shown(s.meshes.size(), false);
  std::size_t total = 0;
  for (const instance& i : s.instances) {
    if (!is_shown[i.mesh]) total += s.meshes[i.mesh].triangle_count();
    is_shown[i.mesh] = true;
  }
  p.corners.reserve(3 * total);
  if (with_normals) p.normals.reserve(3 * total);
  p.triangle_materials.reserve(total);

  std::vector<box3f> bounds(s.meshes.size());
  for (std::size_t k = 0; k < s.meshes.size(); ++k) {
    packed_mesh placed;
    placed.first_triangle = std::uint32_t(p.triangle_materials.size());
    if (is_shown[k]) {
      pack_mesh(s.meshes[k], with_normals, p);
      bounds[k] = s.meshes[k].bounds();
    }
    placed.triangle_count = std::uint32_t(p.triangle_materials.size()) - placed.first_triangle;
    p.meshes.push_back(placed);
  }
  for (std::size_t k = 0; k < s.instances.size(); ++k) {
    const instance& i = s.instances[k];
    const packed_mesh& m = p.meshes[i.mesh];
    if (m.triangle_count == 0) continue;
    Instance q = pack_instance(i, std::uint32_t(k), bounds[i.mesh]);
    q.first_triangle = m.first_triangle;
    q.triangle_count = m.triangle_count;
    p.instances.push_back(q);
    p.instance_meshes.push_back(i.mesh);
  }
  for (const material& m : s.materials) p.materials.push_back(pack_material(m));
  for (const light& l : s.lights) p.lights.push_back(pack_light(l));

  const std::array<float, 3> reach = reach_of(world_box<float>(s));
  std::copy(reach.begin(), reach.end(), p.world.reach);
  p.world.instance_count = std::uint32_t(p.instances.size());
  p.world.triangle_count = std::uint32_t(total);
  return p;
}

std::uint32_t largest_mesh(const packed_scene& p) {
  std::uint32_t largest = 0;
  for (const packed_mesh& m : p.meshes) largest = std::max(largest, m.triangle_count);
  return largest;
}

View pack_view(const scene& s, const std::vector<std::uint32_t>& media, std::uint32_t width,
               std::uint32_t height, std::uint32_t max_depth) {
  const camera_frame f = frame_of(s.view, width, height);
  View v{};
  put(v.origin, f.origin), put(v.corner, f.corner), put(v.dx, f.dx), put(v.dy, f.dy);
  v.width = width;
  v.height = height;
  v.max_depth = max_depth;
  v.samples = s.samples;
  put(v.background, s.background);
  v.background_alpha = s.background_alpha;
  put(v.ambient, s.ambient);
  v.light_count = std::uint32_t(s.lights.size());
  std::fill(std::begin(v.media), std::end(v.media), FACET_NONE);
  std::copy(media.begin(), media.end(), v.media);
  return v;
}

}  // namespace facet::tracer
