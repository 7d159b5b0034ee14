// Where the next ray starts: beyond what rounding can reach, and no farther; and which way it goes
// where shading normals are bad.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>

#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

constexpr double u = 0x1p-24;

/// An object of one size, so many sizes away from the world's origin, by its corners or by its
/// instance's transform.
struct place {
  double size, away;
  bool by_instance;
};

scene placed_sphere(const place& p) {
  const vec3d middle = vec3d(0.62, -0.49, 0.61) * (p.size * p.away);
  scene s = scene_with(generate("icosphere", {{"radius", 1}, {"subdivisions", 3}}));
  if (p.by_instance) {
    s.instances[0].world_from_object = transform::translate(middle) *
                                       transform::rotate({1, 2, 3}, 40) *
                                       transform::scale(vec3d(1, 0.7, -1.2) * p.size);
  } else {
    for (vec3f& c : s.meshes[0].positions) c = vec3f(vec3d(c) * p.size + middle);
  }
  return s;
}

/// What the offset is held against: a bound on how far the rounded point lies from its plane, and
/// how far the next test may see that plane moved. Interpolation costs 7 u of the sum of the shares
/// of the corners, each map between object and world 4 u of its terms (Pharr, Jakob,
/// Humphreys, 6.8: gamma_7, and gamma_3 for a map and one u for its matrix), and the test 8 u of
/// the largest |corner - point|, as in case 6 across the plane.
double error_bound(const scene& s, const tracer::surface_point& at) {
  const mesh& m = s.meshes[0];
  const transform& map = s.instances[0].world_from_object;
  const double w = 1 - double(at.met.u) - double(at.met.v);
  const vec3d p[3] = {vec3d(m.position(at.met.triangle, 0)), vec3d(m.position(at.met.triangle, 1)),
                      vec3d(m.position(at.met.triangle, 2))};
  const vec3d object = p[0] * w + p[1] * double(at.met.u) + p[2] * double(at.met.v);
  vec3d e =
      (abs(p[0]) * std::abs(w) + abs(p[1]) * double(at.met.u) + abs(p[2]) * double(at.met.v)) *
      (7 * u);
  double reach = 0;
  for (const vec3d& c : p)
    for (int i = 0; i < 3; ++i) reach = std::max(reach, std::abs(c[i] - object[i]));
  e = e + vec3d(reach, reach, reach) * (8 * u);
  const auto terms = [](const transform& t, vec3d v) {
    vec3d sum;
    for (int i = 0; i < 3; ++i) {
      const auto& r = t.row[std::size_t(i)];
      sum[i] = std::abs(r[0] * v.x) + std::abs(r[1] * v.y) + std::abs(r[2] * v.z) + std::abs(r[3]);
    }
    return sum * (4 * u);
  };
  if (!map.is_identity()) {
    e = e + terms(map.inverse(), vec3d(at.point));
    transform size = map;
    for (auto& r : size.row)
      for (std::size_t k = 0; k < 4; ++k) r[k] = k < 3 ? std::abs(r[k]) : 0;
    e = size.vector(e) + terms(map, object);
  }
  return dot(abs(vec3d(at.geometric)), e);
}

/// Four ways to leave: along the normal, anywhere, grazing, and grazing to within rounding.
vec3f leaving_direction(vec3d normal, std::uint64_t kind, draw& d) {
  const vec3d across = normalize(cross(normal, d.direction()));
  const double rise = kind == 0 ? 1 : kind == 1 ? d.uniform() : kind == 2 ? 1e-3 : 1e-6;
  const vec3d way = kind == 0 ? normal : across + normal * rise;
  return vec3f(normalize(way));
}

/// Two parallel squares of side 4, `gap` apart, turned by `turn`.
scene two_sheets(double gap, const transform& turn) {
  mesh m;
  for (const double z : {0.0, gap}) {
    const auto corner = [&](double x, double y) { return vec3f(turn.point({x, y, z})); };
    add_loose(m, corner(-2, -2), corner(2, -2), corner(2, 2));
    add_loose(m, corner(-2, -2), corner(2, 2), corner(-2, 2));
  }
  return scene_with(std::move(m));
}

bool is_unit(vec3f v) { return std::abs(length(vec3d(v)) - 1) < 8 * u; }

}  // namespace

void leaving(lab& l) {
  std::vector<place> places;
  for (const double size : {1e-6, 1e-3, 1.0, 1e3, 1e6})
    for (const double away : {0.0, 1.0, 1e3, 1e6})
      for (const bool by_instance : {false, true}) places.push_back({size, away, by_instance});
  double worst_ratio = 0, worst_reach = 0;
  finding total;
  total.what = "self-hits";
  const std::uint64_t share = std::max<std::uint64_t>(1, l.rays / places.size());
  for (const place& p : places) {
    const scene s = placed_sphere(p);
    tracer::device_scene on = l.place(s);
    const vec3d middle = vec3d(0.62, -0.49, 0.61) * (p.size * p.away);
    std::uint64_t again = 0, left = 0;
    in_batches(l, share, [&](std::uint64_t first, std::uint64_t size) {
      std::vector<tracer::ray> rays(size);
      in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
        for (std::uint64_t i = a; i < b; ++i) {
          draw d(l.seed, first + i);
          const vec3f o(middle + d.direction() * (4 * p.size));
          const vec3f to(middle + d.in_cube() * (0.4 * p.size));
          rays[i] = make_ray(o, vec3f(normalize(vec3d(to) - vec3d(o))));
        }
      });
      const auto points = on.surfaces(rays);
      std::vector<double> ratio(size, 0);
      in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
        for (std::uint64_t i = a; i < b; ++i) {
          draw d(l.seed + 1, first + i);
          const tracer::surface_point& at = points[i];
          const bool is_near = d.below(2) == 0;
          const vec3d normal = vec3d(at.geometric) * (is_near ? 1.0 : -1.0);
          rays[i] = make_ray(is_near ? at.near_side : at.far_side,
                             leaving_direction(normal, d.below(4), d));
          if (at.met.triangle != tracer::miss) ratio[i] = double(at.delta) / error_bound(s, at);
        }
      });
      const auto hits = on.trace(rays);
      for (std::uint64_t i = 0; i < size; ++i) {
        if (points[i].met.triangle == tracer::miss) continue;
        ++left;
        worst_ratio = std::max(worst_ratio, ratio[i]);
        worst_reach =
            std::max(worst_reach, double(points[i].delta) / (p.size * std::max(1.0, p.away)));
        if (hits[i].triangle != points[i].met.triangle) continue;
        if (total.failed < total.first.size()) total.first[total.failed] = first + i;
        ++total.failed;
        ++again;
      }
    });
    total.tried += left;
  }
  l.report(total);
  l.report_figure("worst offset over its error bound", worst_ratio, 8, "");
  l.note_figure("worst offset over size or distance", worst_reach, "");
}

void sheets(lab& l) {
  const std::uint64_t count = l.at_most(20000);
  for (const double gap : {1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2})
    for (const bool is_turned : {false, true}) {
      const transform turn = is_turned ? transform::rotate({1, 1, 0.5}, 50) : transform{};
      const scene s = two_sheets(gap, turn);
      tracer::device_scene on = l.place(s);
      std::vector<tracer::ray> rays;
      // From between the sheets to the lower one; then to a light above both.
      for (std::uint64_t i = 0; i < count; ++i) {
        draw d(l.seed, i);
        const vec3d o = turn.point({d.signed_uniform(), d.signed_uniform(), gap / 2});
        const vec3d way = turn.vector({0.3 * d.signed_uniform(), 0.3 * d.signed_uniform(), -1});
        rays.push_back(make_ray(vec3f(o), vec3f(normalize(way))));
      }
      const auto points = on.surfaces(rays);
      double bound = 0;
      std::vector<tracer::ray> to_light;
      for (const tracer::surface_point& at : points) {
        if (at.met.triangle > 1) continue;
        bound = std::max(bound, double(at.delta));
        const vec3f way = vec3f(turn.point({0.5, 0.25, 3})) - at.near_side;
        const float distance = length(way);
        to_light.push_back(make_ray(at.near_side, way / distance, 0, distance));
      }
      finding f;
      char what[96];
      std::snprintf(what, sizeof what, "missed shadows, gap %g%s", gap,
                    is_turned ? ", turned" : "");
      f.what = what;
      f.tried = to_light.size();
      const auto passed = on.passages(to_light);
      for (std::size_t i = 0; i < passed.size(); ++i) {
        if (passed[i].is_dark) continue;
        if (f.failed < f.first.size()) f.first[f.failed] = i;
        ++f.failed;
      }
      // The offset bounds the point's error and the next test's together. The start lies at most
      // the first and the offset above the sheet, and the test may err by the second: twice the
      // offset in all. A mistaken offset has no say in what is asked of it.
      f.is_goal = gap > 2 * (l.wrong ? 2e-6 : bound);
      if (!f.is_goal) f.what += " (below the bound)";
      if (l.on_batch) l.on_batch();
      l.report(std::move(f));
    }
}

void bad_normals(lab& l) {
  // Normals that cancel halfway, that point below the surface, that lie in it, and that are right.
  mesh m;
  const auto add = [&](vec3f n0, vec3f n1, vec3f n2) {
    const auto k = float(m.triangle_count());
    const vec3f at{3 * k, 0, 0};
    add_loose(m, at, at + vec3f(2, 0, 0), at + vec3f(0, 2, 0));
    for (const vec3f n : {n0, n1, n2}) {
      m.normal_indices.push_back(std::uint32_t(m.normals.size()));
      m.normals.push_back(n);
    }
  };
  const vec3f up{0, 0, 1}, down{0, 0, -1}, side{1, 0, 0};
  const vec3f tilted(normalize(vec3d(1, 0, -0.01)));
  add(up, down, up);
  add(up, down, down);
  add(side, -side, side);
  add(tilted, tilted, tilted);
  add(down, down, down);
  add(side, side, side);
  add(up, up, up);
  scene s = scene_with(std::move(m));
  material& glass = s.materials[0];
  glass.Kt = {0.9f, 0.8f, 0.7f};
  glass.Kr = {0.1f, 0.2f, 0.3f};
  glass.Ni = 1.5f;
  for (const bool is_placed : {false, true}) {
    if (is_placed)
      s.instances[0].world_from_object =
          transform::rotate({1, 2, 3}, 70) * transform::scale({1e-3, 1e-2, 1e-3});
    const transform& map = s.instances[0].world_from_object;
    tracer::device_scene on = l.place(s);
    const std::uint64_t count = l.at_most(50000);
    std::vector<tracer::ray> rays;
    for (std::uint64_t i = 0; i < count; ++i) {
      draw d(l.seed, i);
      // Every fourth at the middle of an edge, where opposed normals cancel exactly.
      const vec3d at = vec3d(3.0 * d.below(7), 0, 0) +
                       (i % 4 == 0 ? vec3d(1, d.below(2), 0) : vec3d(d.uniform(), d.uniform(), 0));
      const vec3d o = at + vec3d(d.signed_uniform(), d.signed_uniform(), d.below(2) ? 1 : -1) *
                               (0.1 + d.uniform());
      const vec3f from(map.point(o));
      rays.push_back(make_ray(from, vec3f(normalize(map.point(at) - vec3d(from)))));
    }
    const auto points = on.surfaces(rays);
    if (l.on_batch) l.on_batch();
    std::uint64_t met = 0;
    for (const auto& at : points) met += at.met.triangle != tracer::miss;
    l.report_figure(std::string("share that misses") + (is_placed ? ", placed" : ""),
                    1 - double(met) / double(count), 0.5, "");
    count_failures(
        l,
        std::string("not finite, not unit, or to the wrong side") + (is_placed ? ", placed" : ""),
        count, [&](std::uint64_t i) {
          const tracer::surface_point& at = points[i];
          if (at.met.triangle == tracer::miss) return true;
          const vec3d d(direction_of(rays[i])), n(at.geometric);
          if (!is_unit(at.geometric) || !is_unit(at.shading) || !is_finite(at.near_side) ||
              !is_finite(at.far_side) || !std::isfinite(at.delta))
            return false;
          if (dot(d, n) > 8 * u || dot(d, vec3d(at.shading)) > 8 * u || !at.reflects) return false;
          if (!is_unit(at.reflected) || !(dot(vec3d(at.reflected), n) > -8 * u)) return false;
          return !at.refracts || (is_unit(at.refracted) && dot(vec3d(at.refracted), n) < 8 * u);
        });
  }
}

}  // namespace facet::study
