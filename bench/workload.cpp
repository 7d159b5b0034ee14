#include "bench/workload.hpp"

#include <algorithm>
#include <cmath>

#include "scene/generate.hpp"
#include "scene/read_obj.hpp"

namespace facet::bench {
namespace {

std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// A chain of hashes as numbers in [0, 1).
class random_numbers {
 public:
  explicit random_numbers(std::uint32_t seed) : state_(seed) {}
  float next() {
    state_ = hash(state_ + 0x9e3779b9u);
    return float(state_ >> 8) * 0x1p-24f;
  }

 private:
  std::uint32_t state_;
};

/// By the reciprocal: the rays were defined so.
vec3f unit(vec3f a) { return a * (1.0f / std::sqrt(dot(a, a))); }

/// "kind:n" in the words of the generators, or an OBJ file.
mesh find_mesh(const std::string& name) {
  for (const std::string kind : {"terrain", "soup"})
    if (name.starts_with(kind + ":"))
      return generate(kind, {{"n", std::stod(name.substr(kind.size() + 1))}});
  return read_obj(name).mesh;
}

/// The i-th ray belongs to this pixel: tile after tile, row by row.
void pixel_of(int i, int width, int& x, int& y) {
  const int tile = i / tile_rays, k = i % tile_rays, across = width / tile_width;
  x = tile % across * tile_width + k % tile_width;
  y = tile / across * tile_height + k / tile_width;
}

struct leaving {
  vec3f point, normal;
};

/// A point just outside the surface that was hit, on the ray's side.
leaving leave(const mesh& m, const ray& r, const hit& h) {
  const vec3f a = m.position(h.triangle, 0), b = m.position(h.triangle, 1),
              c = m.position(h.triangle, 2);
  vec3f n = unit(cross(b - a, c - a));
  if (dot(n, r.direction) > 0) n = n * -1.0f;
  return {r.origin + r.direction * h.t + n * 1e-4f, n};
}

}  // namespace

mesh load_workload(const std::string& name) {
  mesh m = find_mesh(name);
  box3f b;
  for (const vec3f& p : m.positions) b.add(p);
  const vec3f centre = b.centre(), e = b.extent();
  const float scale = 1.0f / std::max(e.x, std::max(e.y, e.z));
  for (vec3f& p : m.positions) p = (p - centre) * scale;
  return m;
}

scene scene_of(mesh m) {
  scene s;
  s.materials.emplace_back();
  s.meshes.push_back(std::move(m));
  s.instances.emplace_back();
  return s;
}

std::uint32_t height_for(const scene& s, std::uint32_t width) {
  return std::uint32_t(std::max(1.0, double(width) * s.height / s.width + 0.5));
}

std::vector<ray> primary_rays(int width, int height) {
  const auto w = float(width), h = float(height);
  const vec3f eye{0.75f, 0.55f, 1.05f}, at{0, -0.02f, 0};
  const vec3f forward = unit(at - eye), right = unit(cross(forward, {0, 1, 0})),
              up = cross(right, forward);
  const float half = std::tan(0.5f * 40 * 3.14159265f / 180);
  std::vector<ray> rays(std::size_t(width) * std::size_t(height));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    int x, y;
    pixel_of(int(i), width, x, y);
    const float sx = ((float(x) + 0.5f) / w * 2 - 1) * half * w / h;
    const float sy = (1 - (float(y) + 0.5f) / h * 2) * half;
    rays[i] = {eye, 0, unit(forward + right * sx + up * sy), 1e30f};
  }
  return rays;
}

std::vector<ray> bounce_rays(const mesh& m, const std::vector<ray>& primary,
                             const std::vector<hit>& hits) {
  std::vector<ray> rays;
  for (std::size_t i = 0; i < primary.size(); ++i) {
    if (!hits[i]) continue;
    const auto [p, n] = leave(m, primary[i], hits[i]);
    random_numbers random(std::uint32_t(i) * 2654435761u + 17);
    const float angle = random.next() * 6.2831853f, z = random.next() * 2 - 1;
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    const vec3f sphere{r * std::cos(angle), r * std::sin(angle), z};
    rays.push_back({p, 0, unit(n + sphere * 0.9999f), 1e30f});
  }
  return rays;
}

std::vector<ray> shadow_rays(const mesh& m, const std::vector<ray>& primary,
                             const std::vector<hit>& hits) {
  const vec3f light{1.3f, 1.9f, -0.6f};
  std::vector<ray> rays;
  for (std::size_t i = 0; i < primary.size(); ++i) {
    if (!hits[i]) continue;
    const vec3f p = leave(m, primary[i], hits[i]).point;
    rays.push_back({p, 0, light - p, 1});
  }
  return rays;
}

std::vector<tracer::ray> packed(const std::vector<ray>& rays) {
  std::vector<tracer::ray> to;
  to.reserve(rays.size());
  for (const ray& r : rays)
    to.push_back({{r.origin.x, r.origin.y, r.origin.z},
                  r.tmin,
                  {r.direction.x, r.direction.y, r.direction.z},
                  r.tmax});
  return to;
}

}  // namespace facet::bench
