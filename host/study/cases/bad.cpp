// Numbers and triangles that should not be.
#include <chrono>
#include <cmath>
#include <limits>

#include "reference/tracer.hpp"
#include "scene/mesh_file.hpp"
#include "study/cases/families.hpp"
#include "study/cases/oracle.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// A mesh as a reader makes it, of faces among which every eighth has a corner that is NaN,
/// infinite or too large. The good faces are those of `good`, in order.
mesh read_with_bad_faces(const mesh& good, std::uint64_t seed, bool keep) {
  constexpr float bad[] = {nan, INFINITY, -INFINITY, 1e38f, -3e38f, 1.1e18f};
  mesh raw;
  mesh_builder builder("bad.obj");
  for (std::uint32_t t = 0; t < good.triangle_count(); ++t) {
    for (int is_bad = t % 8 == 0 ? 1 : 0; is_bad >= 0; --is_bad) {
      vec3f p[3] = {good.position(t, 0), good.position(t, 1), good.position(t, 2)};
      draw d(seed, t);
      if (is_bad) p[d.below(3)][int(d.below(3))] = bad[d.below(6)];
      add_loose(raw, p[0], p[1], p[2]);
    }
  }
  if (keep) return raw;
  builder.positions = raw.positions;
  for (std::uint32_t t = 0; t < raw.triangle_count(); ++t) {
    const mesh_builder::corner face[3] = {{3 * t}, {3 * t + 1}, {3 * t + 2}};
    builder.add_face(face, 0);
  }
  return builder.finish("").mesh;
}

tracer::ray ray_at(const mesh& m, std::uint64_t seed, std::uint64_t i) {
  draw d(seed, i);
  const vec3f o(d.direction() * 3.0);
  const vec3f to = m.positions[m.indices[d.below(std::uint32_t(m.indices.size()))]];
  return make_ray(o, vec3f(vec3d(to) * 0.9 - vec3d(o)));
}

double milliseconds(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
      .count();
}

/// A ray with one number that is not finite, or too large to be used.
tracer::ray bad_ray(std::uint64_t seed, std::uint64_t i) {
  draw d(seed, i);
  constexpr float bad[] = {nan, INFINITY, -INFINITY, 1e30f, -3e38f};
  tracer::ray r = make_ray({0, 0, 3}, {0, 0, -1});
  float* fields[] = {&r.origin[0],    &r.origin[1],    &r.origin[2],
                     &r.direction[0], &r.direction[1], &r.direction[2]};
  if (d.below(8) == 0)
    for (float& x : r.direction) x = 0;
  else if (d.below(8) == 0)
    (d.below(2) ? r.tmin : r.tmax) = nan;
  else
    *fields[d.below(6)] = bad[d.below(5)];
  return r;
}

}  // namespace

void bad_vertices(lab& l) {
  // With infinite boxes every ray visits every triangle: the mistake gets a small mesh.
  const mesh good = noisy_sphere(l.rays >= 1000000 && !l.wrong ? 6 : 4);
  const mesh read = read_with_bad_faces(good, l.seed, l.wrong != nullptr);
  const std::size_t bad = (good.triangle_count() + 7) / 8;
  l.report_figure("dropped triangles that are not told of",
                  std::abs(double(bad) - double(read.dropped)), 0, "");
  const scene clean = scene_with(good), s = scene_with(read);
  const reference::tracer<float> serial(clean);
  tracer::device_scene on = l.place(s);
  const std::uint64_t count = l.at_most(20000);
  trace_and_check(
      l, on, "other bits than without them", count,
      [&](std::uint64_t i) { return ray_at(good, l.seed, i); },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        tracer::hit named = h;
        // By its place among the good ones: a bad face stands before each eighth of them.
        if (h.triangle != tracer::miss) {
          const std::uint32_t in_file = read.source_of(h.triangle);
          named.triangle = in_file - in_file / 9 - 1;
        }
        return same_hit(named, serial.closest(serial_ray(r)));
      });
  std::vector<tracer::ray> rays;
  for (std::uint64_t i = 0; i < count; ++i) rays.push_back(ray_at(good, l.seed, i));
  const auto took = [&](const scene& of) {
    double best = INFINITY;
    for (int k = 0; k < 3; ++k)
      best = std::min(best, milliseconds([&] { l.place(of).trace(rays); }));
    return best;
  };
  const double with = took(s), without = took(clean);
  l.report_figure("time over that without them", with / without, 2.5, "");

  std::vector<tracer::ray> unusable;
  for (std::uint64_t i = 0; i < count; ++i) unusable.push_back(bad_ray(l.seed, i));
  tracer::statistics stats;
  const auto hits = on.trace(unusable, false, 1, &stats);
  count_failures(l, "bad rays that meet something", count,
                 [&](std::uint64_t i) { return hits[i].triangle == tracer::miss; });
  l.report_figure("bad rays not counted as refused", double(count) - double(stats.refused), 0, "");
}

void zero_areas(lab& l) {
  // Each triangle of a sphere is joined by three without an area: a point, a line, one that uses
  // a corner twice. Rays at their corners and along them must meet the sphere's own alone.
  const mesh sphere = generate("icosphere", {{"radius", 1}, {"subdivisions", 3}});
  mesh m;
  m.positions = sphere.positions;
  m.indices = sphere.indices;
  const auto count = std::uint32_t(sphere.triangle_count());
  for (std::uint32_t t = 0; t < count; ++t) {
    const vec3f a = sphere.position(t, 0), b = sphere.position(t, 1);
    const vec3f lifted = a * 1.25f;
    add_loose(m, lifted, lifted, lifted);
    // Halfway is exact in binary, so the three are on one line.
    const vec3f p(std::ldexp(std::rint(std::ldexp(a.x, 12)), -12),
                  std::ldexp(std::rint(std::ldexp(a.y, 12)), -12), 1.5f);
    const vec3f q = p + vec3f(0.25f, -0.5f, 0.125f);
    add_loose(m, p, p + (q - p) * 0.5f, q);
    add_loose(m, a * 1.5f, b * 1.5f, a * 1.5f);
  }
  const scene s = scene_with(std::move(m)), plain = scene_with(sphere);
  const mesh& all = s.meshes[0];
  const reference::tracer<float> serial(s);
  const reference::tracer<float> alone(plain);
  tracer::device_scene on = l.place(s);
  trace_and_check(
      l, on, "a hit of one without an area, NaN, or other bits", l.at_most(50000),
      [&](std::uint64_t i) {
        draw d(l.seed, i);
        const std::uint32_t t = count + d.below(3 * count);
        const vec3f a = all.position(t, int(d.below(3))), b = all.position(t, int(d.below(3)));
        const vec3f target = a + (b - a) * (d.below(2) ? 0.5f : float(d.uniform()));
        const vec3f o(d.direction() * 4.0);
        // Half of them along an axis, where a point is met exactly.
        if (d.below(2) == 0) return make_ray({target.x, target.y, 4}, {0, 0, -1});
        return make_ray(o, target - o);
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        const auto found = serial.closest(serial_ray(r));
        const auto expected = alone.closest(serial_ray(r));
        // The larger mesh's slabs are padded by more, but clamp no t that is inside them.
        return same_hit(h, found) && (h.triangle == tracer::miss || h.triangle < count) &&
               h.triangle == expected.triangle && std::isfinite(h.u) && std::isfinite(h.v);
      });
}

}  // namespace facet::study
