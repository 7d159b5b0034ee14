// Scenes that move on a device, beside ones that are made anew.
#pragma once

#include <doctest/doctest.h>

#include <cstring>
#include <string>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"
#include "tracer/tracer.hpp"

namespace facet::test {

struct way {
  std::string name;
  tracer::options options;
};

/// Layouts, trees, packets and images, all to be moved.
inline std::vector<way> ways_to_move() {
  using namespace tracer;
  std::vector<way> all;
  const auto add = [&](const char* name, layout_kind layout, tree_kind tree) -> options& {
    options o;
    o.layout = layout, o.tree = tree, o.movable = true;
    return all.emplace_back(way{name, o}).options;
  };
  add("narrow, binned", layout_kind::narrow, tree_kind::binned);
  add("narrow, levels", layout_kind::narrow, tree_kind::levels);
  add("narrow, no tree", layout_kind::narrow, tree_kind::none);
  add("images", layout_kind::narrow, tree_kind::binned).geometry = geometry_kind::image;
  add("wide, binned", layout_kind::wide, tree_kind::binned).packets = packet_kind::off;
  add("packets", layout_kind::wide, tree_kind::levels).packets = packet_kind::on;
  add("wide, no tree", layout_kind::wide, tree_kind::none);
  return all;
}

/// Rays at corners of triangles and at points between them, where t, u and v are hard to get right.
inline std::vector<tracer::ray> rays_at(const scene& s, std::size_t n, std::uint64_t seed) {
  random r(seed);
  std::vector<tracer::ray> rays;
  for (std::size_t k = 0; k < n; ++k) {
    const instance& i = s.instances[r.below(std::uint32_t(s.instances.size()))];
    const mesh& m = s.meshes[i.mesh];
    const box3f b = m.bounds();
    const std::uint32_t t = r.below(std::uint32_t(m.triangle_count()));
    const float u = k % 3 == 0 || k % 8 == 0 ? 0 : 0.5f * r.uniform(),
                v = k % 3 == 1 || k % 8 == 0 ? 0 : 0.5f * r.uniform();
    const vec3f at = m.position(t, 0) * (1 - u - v) + m.position(t, 1) * u + m.position(t, 2) * v;
    // Along an axis a corner is met exactly.
    const vec3f from = k % 8 == 0 ? at + vec3f(0, 0, 1)
                                  : b.centre() + r.in_cube() * (2 * length(b.extent()) + 1e-3f);
    const vec3d o = i.world_from_object.point(vec3d(from)),
                d = i.world_from_object.point(vec3d(at)) - o;
    rays.push_back({{float(o.x), float(o.y), float(o.z)},
                    0,
                    {float(d.x), float(d.y), float(d.z)},
                    k % 5 == 0 ? 1.5f : INFINITY});
  }
  return rays;
}

/// Closest hits, bit for bit, any hits, and rays that were refused.
inline std::size_t differing_hits(tracer::device_scene& a, tracer::device_scene& b,
                                  const std::vector<tracer::ray>& rays) {
  tracer::statistics of_a, of_b;
  const auto x = a.trace(rays, false, 1, &of_a), y = b.trace(rays, false, 1, &of_b);
  const auto p = a.trace(rays, true), q = b.trace(rays, true);
  std::size_t differing = of_a.refused != of_b.refused;
  for (std::size_t i = 0; i < rays.size(); ++i)
    differing +=
        std::memcmp(&x[i], &y[i], sizeof x[i]) != 0 || std::memcmp(&p[i], &q[i], sizeof p[i]) != 0;
  return differing;
}

/// Against a scene that is made anew.
inline std::size_t differing_hits(tracer::device_scene& moved, const scene& now,
                                  const tracer::options& o, std::uint64_t seed) {
  tracer::device_scene anew(queue(), now, o);
  std::vector<tracer::ray> rays = rays_at(now, 600, seed);
  const auto more = random_rays(200, seed);
  rays.insert(rays.end(), more.begin(), more.end());
  return differing_hits(moved, anew, rays);
}

inline bool same_picture(tracer::device_scene& a, tracer::device_scene& b, const scene& s) {
  tracer::statistics of_a, of_b;
  const picture p = a.render(48, 32, s.max_depth, &of_a), q = b.render(48, 32, s.max_depth, &of_b);
  return of_a.refused == of_b.refused && of_a.crowded == of_b.crowded &&
         std::memcmp(p.rgba.data(), q.rgba.data(), p.rgba.size() * sizeof(float)) == 0;
}

/// Deformations, each of the vertices as they were at first.
struct deformation {
  std::string name;
  std::vector<vec3f> (*apply)(const std::vector<vec3f>& from);
};

template <class F>
std::vector<vec3f> each(const std::vector<vec3f>& from, F f) {
  std::vector<vec3f> to;
  for (const vec3f& p : from) to.push_back(f(p));
  return to;
}

inline const std::vector<deformation>& deformations() {
  using vertices = std::vector<vec3f>;
  static const std::vector<deformation> all{
      {"jittered",
       [](const vertices& v) {
         random r(11);
         return each(v, [&](vec3f p) { return p + r.in_cube() * 0.2f; });
       }},
      {"shuffled",
       [](const vertices& v) {
         random r(12);
         return each(v, [&](vec3f) { return r.in_cube(); });
       }},
      {"one vertex far away",
       [](const vertices& v) {
         vertices to = v;
         to[to.size() / 2] = {1e6f, -3e5f, 7};
         return to;
       }},
      {"a million times as large",
       [](const vertices& v) { return each(v, [](vec3f p) { return p * 1e6f; }); }},
      {"tiny", [](const vertices& v) { return each(v, [](vec3f p) { return p * 1e-18f; }); }},
      {"far away, so that rounding flattens some",
       [](const vertices& v) { return each(v, [](vec3f p) { return p + vec3f(1e6f, 2e6f, 0); }); }},
      {"one point", [](const vertices& v) { return vertices(v.size(), vec3f(0.1f, 0.2f, 0.3f)); }},
      {"a line",
       [](const vertices& v) { return each(v, [](vec3f p) { return vec3f(p.x, 0, 0); }); }},
      {"a plane",
       [](const vertices& v) { return each(v, [](vec3f p) { return vec3f(p.x, 0.5f, p.z); }); }},
      {"a half on one point",
       [](const vertices& v) {
         vertices to = v;
         for (std::size_t i = 0; i < to.size() / 2; ++i) to[i] = v[0];
         return to;
       }},
      {"as before", [](const vertices& v) { return v; }},
  };
  return all;
}

}  // namespace facet::test
