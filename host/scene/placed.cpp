#include "scene/placed.hpp"

#include <algorithm>
#include <cmath>

#include "scene/media.hpp"
#include "scene/world_bounds.hpp"

namespace facet {
namespace {

bool is_at_rest(const scene& s) {
  return s.instances.size() == 1 && s.instances[0].world_from_object.is_identity() &&
         s.instances[0].material == instance::own_materials;
}

double largest(vec3d v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool is_near(const box3d& b) {
  return b.empty() ||
         std::max(largest(b.lo), largest(b.hi)) <= limits::placed_distance * largest(b.hi - b.lo);
}

bool is_worth_placing(const scene& s) {
  if (s.instances.empty() || is_at_rest(s)) return false;
  const std::uint64_t shown = s.placed_triangle_count();
  if (shown > std::max<std::uint64_t>(limits::placed_triangles,
                                      limits::placed_copies * s.triangle_count()) ||
      shown > limits::triangles)
    return false;
  std::vector<box3f> bounds;
  for (const mesh& m : s.meshes) bounds.push_back(m.bounds());
  return std::all_of(s.instances.begin(), s.instances.end(), [&](const instance& i) {
    const box3d b = world_box<double>(i.world_from_object, bounds[i.mesh]);
    return is_near(b) && (b.empty() || std::max(largest(b.lo), largest(b.hi)) < limits::coordinate);
  });
}

/// No normal: the triangle's own is taken.
constexpr std::uint32_t flat = 0;

vec3f placed_normal(const transform& object_from_world, vec3f n) {
  const vec3d v = object_from_world.transposed_vector(vec3d(n));
  const double size = length(v);
  return size > 0 && std::isfinite(size) ? vec3f(v / size) : vec3f();
}

void append(const mesh& m, const instance& i, bool with_normals, mesh& to) {
  const transform& map = i.world_from_object;
  const auto first = std::uint32_t(to.positions.size()),
             first_normal = std::uint32_t(to.normals.size());
  for (const vec3f& p : m.positions) to.positions.push_back(vec3f(map.point(vec3d(p))));
  if (with_normals && m.is_smooth()) {
    const transform back = map.inverse();
    for (const vec3f& n : m.normals) to.normals.push_back(placed_normal(back, n));
  }
  const bool is_mirrored = map.determinant() < 0;
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    for (const std::size_t c : {0, 1, 2}) {
      const std::size_t from = 3 * t + (is_mirrored && c > 0 ? 3 - c : c);
      to.indices.push_back(first + m.indices[from]);
      if (with_normals)
        to.normal_indices.push_back(m.is_smooth() ? first_normal + m.normal_indices[from] : flat);
    }
    to.materials.push_back(i.material == instance::own_materials ? m.material_of(t) : i.material);
  }
}

}  // namespace

scene placed(scene s) {
  if (!is_worth_placing(s)) return s;
  s.around_camera = media_around_camera(s);
  mesh all;
  all.name = s.name;
  const bool with_normals =
      std::any_of(s.instances.begin(), s.instances.end(),
                  [&](const instance& i) { return s.meshes[i.mesh].is_smooth(); });
  if (with_normals) all.normals.push_back({});
  for (const instance& i : s.instances) append(s.meshes[i.mesh], i, with_normals, all);
  s.meshes.clear();
  s.meshes.push_back(std::move(all));
  s.instances.assign(1, {});
  return s;
}

}  // namespace facet
