#include "study/tuning_workloads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/framing.hpp"
#include "scene/generate.hpp"
#include "scene/load.hpp"
#include "scene/placed.hpp"
#include "scene/world_bounds.hpp"
#include "study/still_life.hpp"
#include "tracer/layout.hpp"

namespace facet::study {
namespace {

/// The mesh from so near that it fills most of the picture.
scene near_view(const std::string& name, const std::string& kind, const generator_parameters& p) {
  scene s = scene_of_mesh({generate(kind, p), {}, {}}, name);
  const box3d b = world_box<double>(s);
  const vec3d e = b.extent();
  s.view.look_at = b.centre();
  s.view.position = b.centre() + vec3d{0.6, 0.45, 0.85} * std::max({e.x, e.y, e.z});
  s.lights = {key_light_for(s.view)};
  return s;
}

tracer::ray ray_from(vec3d origin, vec3d direction, float tmax) {
  const vec3f o(origin), d(direction);
  return {{o.x, o.y, o.z}, 0, {d.x, d.y, d.z}, tmax};
}

vec3d vector_of(const float* v) { return {v[0], v[1], v[2]}; }

/// Where a ray leaves the surface that another has hit, on that one's side.
struct departure {
  vec3d point, normal;
};

departure leave(const scene& s, const tracer::ray& r, const tracer::hit& h) {
  const instance& i = s.instances[h.instance];
  const mesh& m = s.meshes[i.mesh];
  const auto corner = [&](int k) {
    return i.world_from_object.point(vec3d(m.position(h.triangle, k)));
  };
  const vec3d a = corner(0), b = corner(1), c = corner(2);
  const vec3d along = vector_of(r.direction);
  vec3d n = normalize(cross(b - a, c - a));
  if (dot(n, along) > 0) n = -n;
  const vec3d way = along * double(h.t);
  // Far enough from the surface for any of these scenes, and not seen in how far rays go.
  return {vector_of(r.origin) + way + n * (1e-4 * length(way)), n};
}

tracer::ray shadow_ray(const departure& from, const light& to) {
  if (to.type == light::kind::directional)
    return ray_from(from.point, -normalize(to.direction), INFINITY);
  return ray_from(from.point, to.position - from.point, 1);
}

/// Unit normal plus a unit vector drawn over the sphere: by the cosine.
tracer::ray bounce_ray(const departure& from, std::mt19937_64& random) {
  const auto uniform = [&] { return double(random() >> 11) * 0x1p-53; };
  const double z = 2 * uniform() - 1, angle = 2 * std::numbers::pi * uniform();
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  // Of a length below 1, so that the sum is not 0.
  const vec3d sphere = vec3d{r * std::cos(angle), r * std::sin(angle), z} * 0.9999;
  return ray_from(from.point, normalize(from.normal + sphere), INFINITY);
}

tuning_workload of_rays(const tuning_scene& s, std::uint32_t index, const char* kind) {
  tuning_workload w;
  w.name = s.what.name + ": " + kind + " rays";
  w.scene = index;
  return w;
}

}  // namespace

std::vector<tuning_scene> tuning_scenes(std::uint32_t width, bool is_quick) {
  const std::uint32_t height = std::max(1u, width * 9 / 16);
  const double segments = is_quick ? 60 : 600, sides = is_quick ? 8 : 60, n = is_quick ? 50 : 500;
  std::vector<tuning_scene> all;
  all.push_back(
      {near_view("knot", "torus_knot", {{"segments", segments}, {"sides", sides}, {"smooth", 1}}),
       width, height, true, true});
  all.push_back({near_view("hills", "terrain", {{"n", n}}), width, height, true, false});
  scene deep =
      placed(still_life(generate("torus_knot", {{"segments", segments}, {"sides", sides}})));
  deep.max_depth = 8;
  all.push_back({std::move(deep), width, height, false, true});
  return all;
}

std::vector<tracer::ray> eye_rays_in_tiles(const scene& s, std::uint32_t width,
                                           std::uint32_t height) {
  constexpr std::uint32_t columns = FACET_PACKET_COLUMNS, rows = FACET_PACKET_ROWS;
  const camera_frame f = frame_of(s.view, width, height);
  std::vector<tracer::ray> rays;
  rays.reserve(std::size_t(width) * height);
  for (std::uint32_t top = 0; top < height; top += rows)
    for (std::uint32_t left = 0; left < width; left += columns)
      for (std::uint32_t y = top; y < std::min(height, top + rows); ++y)
        for (std::uint32_t x = left; x < std::min(width, left + columns); ++x)
          rays.push_back(ray_from(
              f.origin, normalize(f.corner + f.dx * (x + 0.5) + f.dy * (y + 0.5)), INFINITY));
  return rays;
}

std::vector<tuning_workload> workloads_of(tracer::device_scene& on, const tuning_scene& s,
                                          std::uint32_t index) {
  std::vector<tuning_workload> all;
  if (s.with_picture) {
    tuning_workload& w = all.emplace_back();
    w.name = s.what.name + ": picture";
    w.scene = index;
    w.is_picture = true;
    w.width = s.width, w.height = s.height, w.max_depth = s.what.max_depth;
  }
  if (!s.with_rays) return all;
  tuning_workload eye = of_rays(s, index, "eye"), shadow = of_rays(s, index, "shadow"),
                  bounce = of_rays(s, index, "bounce");
  eye.rays = eye_rays_in_tiles(s.what, s.width, s.height);
  shadow.any = true;
  const std::vector<tracer::hit> hits = on.trace(eye.rays);
  std::mt19937_64 random(1);
  for (std::size_t k = 0; k < hits.size(); ++k) {
    if (hits[k].triangle == tracer::miss) continue;
    const departure from = leave(s.what, eye.rays[k], hits[k]);
    if (!s.what.lights.empty()) shadow.rays.push_back(shadow_ray(from, s.what.lights[0]));
    bounce.rays.push_back(bounce_ray(from, random));
  }
  for (tuning_workload* w : {&eye, &shadow, &bounce})
    if (!w->rays.empty()) all.push_back(std::move(*w));
  return all;
}

}  // namespace facet::study
