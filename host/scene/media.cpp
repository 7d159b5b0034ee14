#include "scene/media.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "scene/error.hpp"
#include "scene/world_bounds.hpp"

namespace facet {
namespace {

/// The solid angle under which p0 p1 p2 appears from the origin, positive where they turn
/// counter-clockwise seen from the other side.
double solid_angle(vec3d p0, vec3d p1, vec3d p2) {
  const double a = length(p0), b = length(p1), c = length(p2);
  const double volume = dot(p0, cross(p1, p2));
  const double span = a * b * c + dot(p0, p1) * c + dot(p1, p2) * a + dot(p2, p0) * b;
  return 2 * std::atan2(volume, span);
}

bool holds(const box3d& b, vec3d p) {
  return b.lo.x <= p.x && p.x <= b.hi.x && b.lo.y <= p.y && p.y <= b.hi.y && b.lo.z <= p.z &&
         p.z <= b.hi.z;
}

bool shows_glass(const scene& s, const instance& i) {
  if (i.material != instance::own_materials) return s.materials[i.material].is_transparent();
  const mesh& m = s.meshes[i.mesh];
  if (m.materials.empty()) return s.materials[0].is_transparent();
  return std::any_of(m.materials.begin(), m.materials.end(),
                     [&](std::uint32_t k) { return s.materials[k].is_transparent(); });
}

}  // namespace

std::vector<double> winding_numbers(const mesh& m, std::size_t material_count, vec3d p) {
  std::vector<double> angles(material_count, 0);
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    angles[m.material_of(t)] += solid_angle(
        vec3d(m.position(t, 0)) - p, vec3d(m.position(t, 1)) - p, vec3d(m.position(t, 2)) - p);
  for (double& a : angles) a /= 4 * std::numbers::pi;
  return angles;
}

std::vector<std::uint32_t> media_at(const scene& s, vec3d p) {
  struct around {
    double size;
    std::uint32_t material;
  };
  std::vector<around> found;
  // Bounds are a pass over a mesh: once for each that is asked for, not for each of its instances.
  std::vector<std::optional<box3f>> bounds(s.meshes.size());
  for (const instance& i : s.instances) {
    if (!shows_glass(s, i)) continue;
    if (!bounds[i.mesh]) bounds[i.mesh] = s.meshes[i.mesh].bounds();
    const box3d box = world_box<double>(i.world_from_object, *bounds[i.mesh]);
    if (!holds(box, p)) continue;
    const std::vector<double> windings = winding_numbers(s.meshes[i.mesh], s.materials.size(),
                                                         i.world_from_object.inverse().point(p));
    const bool is_replaced = i.material != instance::own_materials;
    double whole = 0;
    for (std::uint32_t k = 0; k < windings.size(); ++k) {
      whole += windings[k];
      if (!is_replaced && s.materials[k].is_transparent() && windings[k] > 0.5)
        found.push_back({box.half_area(), k});
    }
    if (is_replaced && whole > 0.5) found.push_back({box.half_area(), i.material});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const around& a, const around& b) { return a.size < b.size; });
  std::vector<std::uint32_t> materials;
  for (const around& a : found) materials.push_back(a.material);
  return materials;
}

std::vector<std::uint32_t> media_around_camera(const scene& s) {
  return s.around_camera ? *s.around_camera : media_at(s, s.view.position);
}

void check_camera_media(const scene& s, const std::vector<std::uint32_t>& media) {
  if (media.size() <= s.nesting) return;
  std::string names;
  for (const std::uint32_t k : media) {
    const std::string& name = s.materials[k].name;
    names += (names.empty() ? "" : ", ") + (name.empty() ? std::to_string(k) : name);
  }
  throw scene_error("", "/nesting",
                    "the camera lies in " + std::to_string(media.size()) +
                        " transparent objects at once (" + names + "), and " +
                        std::to_string(s.nesting) + " are allowed for; set it to " +
                        std::to_string(media.size()) + " (at most " +
                        std::to_string(limits::nesting) + "), or move the camera");
}

}  // namespace facet
