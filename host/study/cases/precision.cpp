// The distance of a hit against the exact one: slivers, grazing rays, directions of any length.
#include <algorithm>
#include <cmath>
#include <limits>

#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

constexpr double u = 0x1p-24;

std::array<vec3d, 3> corners(const mesh& m, std::uint32_t triangle) {
  return {vec3d(m.position(triangle, 0)), vec3d(m.position(triangle, 1)),
          vec3d(m.position(triangle, 2))};
}

double ulp_of(double t) {
  const float f = float(std::abs(t));
  return double(std::nextafter(f, INFINITY)) - double(f);
}

vec3d across(vec3d a, draw& d) { return normalize(cross(a, d.direction())); }

/// A point of the triangle whose shares of the corners are all at least `least`.
vec3d inner_point(const std::array<vec3d, 3>& p, double least, draw& d) {
  double a = d.uniform(), b = d.uniform();
  if (a + b > 1) a = 1 - a, b = 1 - b;
  const double rest = 1 - 3 * least;
  return p[0] * (least + rest * (1 - a - b)) + p[1] * (least + rest * a) +
         p[2] * (least + rest * b);
}

/// The value that a share of `q` of the sorted errors do not exceed.
double quantile(std::vector<double> errors, double q) {
  if (errors.empty()) return std::numeric_limits<double>::infinity();
  const auto at = errors.begin() + std::ptrdiff_t(double(errors.size() - 1) * q);
  std::nth_element(errors.begin(), at, errors.end());
  return *at;
}

/// Loose triangles of length 1 and width 1/aspect, in any direction.
mesh loose_slivers(double aspect, std::uint64_t seed) {
  mesh m;
  for (std::uint32_t k = 0; k < 64; ++k) {
    draw d(seed, k);
    const vec3d apex = d.in_cube(), along = d.direction(), side = across(along, d) * (0.5 / aspect);
    add_loose(m, vec3f(apex), vec3f(apex + along + side), vec3f(apex + along - side));
  }
  return m;
}

}  // namespace

void slivers(lab& l) {
  const std::uint64_t count = l.at_most(20000);
  for (const double aspect : {1e2, 1e3, 1e4, 1e5, 1e6}) {
    const scene s = scene_with(loose_slivers(aspect, l.seed));
    const mesh& m = s.meshes[0];
    std::vector<tracer::ray> rays;
    for (std::uint64_t i = 0; rays.size() < count; ++i) {
      draw d(l.seed + 1, i);
      const auto p = corners(m, d.below(std::uint32_t(m.triangle_count())));
      const vec3d o(vec3f(d.in_cube() * 3.0)), to = inner_point(p, 0.01, d) - o;
      // From 10 degrees on: what lies below is case 6.
      const vec3d normal = normalize(cross(p[1] - p[0], p[2] - p[0]));
      if (std::abs(dot(normal, normalize(to))) > 0.17)
        rays.push_back(make_ray(vec3f(o), vec3f(normalize(to))));
    }
    tracer::device_scene on = l.place(s);
    const auto hits = on.trace(rays);
    std::vector<double> errors;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].triangle == tracer::miss) continue;
      const double t = plane_distance(vec3d(origin_of(rays[i])), vec3d(direction_of(rays[i])),
                                      corners(m, hits[i].triangle));
      errors.push_back(std::abs(double(hits[i].t) - t) / ulp_of(t));
    }
    if (l.on_batch) l.on_batch();
    char what[64];
    // Rounding may carry a ray past a sliver of a millionth, but not past most of them.
    std::snprintf(what, sizeof what, "share missed, aspect %g", aspect);
    l.report_figure(what, 1 - double(errors.size()) / double(rays.size()), 0.5, "");
    std::snprintf(what, sizeof what, "99%% of errors of t, aspect %g", aspect);
    l.report_figure(what, quantile(errors, 0.99), 32, "ulp");
  }
}

void grazing(lab& l) {
  // How far t may be off: corners relative to the ray are rounded by u, their sheared x and y by 3
  // u and z by 3 u of R, the largest |corner - origin|; edge functions by 2 u. The sum weighs three
  // corners (4 u more). A displacement across the ray counts 1/tan of the angle, and shearing
  // stretches it by at most sqrt(3): |dt| <= u R (8 + 13 / sin), with |d_z| >= |d|/sqrt(3) then 25
  // u R / sin(angle).
  constexpr double bound = 25;
  const std::uint64_t count = l.at_most(20000);
  for (const double angle : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    // Far from the world's origin, near to the rays': only corner - origin should count.
    const vec3d middle(91, -57, 74);
    mesh m;
    for (std::uint32_t k = 0; k < 64; ++k) {
      draw d(l.seed, k);
      const vec3d a = middle + d.in_cube() * 0.5;
      add_loose(m, vec3f(a + d.in_cube()), vec3f(a + d.in_cube()), vec3f(a + d.in_cube()));
    }
    const scene s = scene_with(std::move(m));
    const mesh& loose = s.meshes[0];
    std::vector<tracer::ray> rays;
    for (std::uint64_t i = 0; i < count; ++i) {
      draw d(l.seed + 2, i);
      const auto p = corners(loose, d.below(std::uint32_t(loose.triangle_count())));
      const vec3d normal = normalize(cross(p[1] - p[0], p[2] - p[0]));
      const vec3d way = across(normal, d) * std::cos(angle) - normal * std::sin(angle);
      const vec3d o = inner_point(p, 0.1, d) - way * (0.2 + d.uniform());
      rays.push_back(make_ray(vec3f(o), vec3f(way)));
    }
    tracer::device_scene on = l.place(s);
    const auto hits = on.trace(rays);
    double worst = 0;
    std::uint64_t met = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      if (hits[i].triangle == tracer::miss) continue;
      const vec3d o(origin_of(rays[i])), way(direction_of(rays[i]));
      const auto p = corners(loose, hits[i].triangle);
      const vec3d normal = normalize(cross(p[1] - p[0], p[2] - p[0]));
      const double sine = std::abs(dot(normal, normalize(way)));
      const double t = plane_distance(o, way, p);
      if (!(sine > 1e-9) || !std::isfinite(t)) continue;
      double reach = 0;
      for (const vec3d& c : p)
        for (int k = 0; k < 3; ++k) reach = std::max(reach, std::abs(c[k] - o[k]));
      ++met;
      worst = std::max(worst, std::abs(double(hits[i].t) - t) / (u * reach / sine));
    }
    if (l.on_batch) l.on_batch();
    char what[80];
    std::snprintf(what, sizeof what, "worst error of t over u R / sin, %g rad (%llu hits)", angle,
                  static_cast<unsigned long long>(met));
    l.report_figure(what, worst, bound, "");
  }
}

void extreme_directions(lab& l) {
  mesh m;
  add_loose(m, {-0.25f, -0.5f, 0.125f}, {0.75f, -0.25f, -0.125f}, {0.0f, 0.5f, 0.25f});
  const scene s = scene_with(std::move(m));
  const auto p = corners(s.meshes[0], 0);
  tracer::device_scene on = l.place(s);
  const std::uint64_t count = l.at_most(20000);
  for (const double length :
       {1e-45, 1e-42, 1e-38, 1e-30, 1e-25, 1e-18, 1e-10, 1.0, 1e10, 1e18, 1e19, 1e38}) {
    std::vector<tracer::ray> rays;
    std::uint64_t unusable = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      draw d(l.seed, i);
      const vec3d o(vec3f(d.direction() * 2.0));
      const vec3f way(normalize(inner_point(p, -0.2, d) - o) * length);
      rays.push_back(make_ray(vec3f(o), way));
      const vec3f a = abs(way);
      const float largest = std::max(a.x, std::max(a.y, a.z));
      unusable += !(largest >= 0x1p-60f && largest <= 0x1p60f);
    }
    tracer::statistics stats;
    const auto hits = on.trace(rays, false, 1, &stats);
    char what[64];
    std::snprintf(what, sizeof what, "wrong and not refused, length %g", length);
    count_failures(l, what, count, [&](std::uint64_t i) {
      const vec3f way = direction_of(rays[i]), a = abs(way);
      const float largest = std::max(a.x, std::max(a.y, a.z));
      const tracer::hit& h = hits[i];
      if (!(largest >= 0x1p-60f && largest <= 0x1p60f)) return h.triangle == tracer::miss;
      const vec3d o(origin_of(rays[i]));
      const auto exact = meet_exactly(o, vec3d(way), p);
      // Within 16 u of an edge rounding may decide: sheared corners are within 4 u of 2.5 units.
      if (exact && exact->least_share > 32 * u && h.triangle == tracer::miss) return false;
      if (h.triangle == tracer::miss) return true;
      const double t = plane_distance(o, vec3d(way), p);
      const vec3d normal = normalize(cross(p[1] - p[0], p[2] - p[0]));
      const double sine = std::abs(dot(normal, normalize(vec3d(way))));
      // As in case 6, with R of at most 3.
      return std::abs(double(h.t) - t) * length <= 25 * u * 3 / sine;
    });
    std::snprintf(what, sizeof what, "refused but not counted, length %g", length);
    finding f;
    f.what = what;
    f.tried = count;
    f.failed = unusable > stats.refused ? unusable - stats.refused : stats.refused - unusable;
    l.report(f);
  }
}

}  // namespace facet::study
