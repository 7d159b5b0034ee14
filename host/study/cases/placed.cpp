// Instances: what is met, its normal, and the seam between two of them.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

constexpr double u = 0x1p-24;

/// A turn, a stretch, a shear and a mirror, one within another, at most 3 to 1 each.
transform nested(draw& d, double size) {
  transform shear;
  shear.row[0][1] = d.signed_uniform();
  shear.row[2][0] = 0.5 * d.signed_uniform();
  const auto factor = [&] { return std::exp2(d.signed_uniform()); };
  const double x = factor(), y = factor(), z = factor();
  const transform inner = transform::rotate(d.direction(), 360 * d.uniform()) * shear;
  const transform outer = transform::rotate(d.direction(), 360 * d.uniform()) *
                          transform::scale({x, y, d.below(2) ? z : -z});
  return outer * inner * transform::scale({size, size, size});
}

double norm(const transform& t) {
  double sum = 0;
  for (const auto& r : t.row) sum += r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
  return std::sqrt(sum);
}

/// 8 x 8 x 8 octants of icosahedra, sizes apart, each with its own map.
scene icosahedra(double size, std::uint64_t seed) {
  scene s = scene_with(generate("icosphere", {{"radius", 1}, {"subdivisions", 0}}));
  s.instances.clear();
  for (std::uint32_t k = 0; k < 64; ++k) {
    draw d(seed, k);
    const vec3d cell(k % 4, k / 4 % 4, k / 16);
    s.instances.push_back(
        {0, transform::translate((cell - vec3d(1.5, 1.5, 1.5)) * (20 * size)) * nested(d, size),
         instance::own_materials});
  }
  return s;
}

std::array<vec3d, 3> corners(const mesh& m, std::uint32_t t) {
  return {vec3d(m.position(t, 0)), vec3d(m.position(t, 1)), vec3d(m.position(t, 2))};
}

/// What the ray meets first of one instance, in rationals from the ray as double sees it there;
/// miss if it is too near to an edge for that to be certain.
std::uint32_t expected_triangle(const mesh& m, const transform& object_from_world,
                                const tracer::ray& r) {
  const vec3d o = object_from_world.point(vec3d(origin_of(r))),
              way = object_from_world.vector(vec3d(direction_of(r)));
  std::uint32_t best = tracer::miss;
  double t = INFINITY;
  for (std::uint32_t k = 0; k < m.triangle_count(); ++k) {
    const auto hit = meet_exactly(o, way, corners(m, k));
    if (!hit || hit->t < 0 || hit->t >= t) continue;
    t = hit->t;
    best = hit->least_share > 1e-3 ? k : tracer::miss;
  }
  return best;
}

}  // namespace

void placed(lab& l) {
  const std::uint64_t count = l.at_most(20000) / 7;
  for (const double size : {1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6}) {
    const scene s = icosahedra(size, l.seed);
    const mesh& m = s.meshes[0];
    std::vector<tracer::ray> rays;
    std::vector<std::uint32_t> targets;
    for (std::uint64_t i = 0; i < count; ++i) {
      draw d(l.seed + 1, i);
      const std::uint32_t k = d.below(std::uint32_t(s.instances.size()));
      const transform& map = s.instances[k].world_from_object;
      const vec3d middle = map.point({0, 0, 0});
      // From within the empty space around it, to a point inside it.
      const vec3f o(middle + d.direction() * (8 * size));
      const vec3f to(map.point(d.in_cube() * 0.4));
      rays.push_back(make_ray(o, vec3f(normalize(vec3d(to) - vec3d(o)))));
      targets.push_back(k);
    }
    tracer::device_scene on = l.place(s);
    const auto points = on.surfaces(rays);
    if (l.on_batch) l.on_batch();
    char what[96];
    std::snprintf(what, sizeof what, "wrong instance or triangle, scale %g", size);
    count_failures(l, what, count, [&](std::uint64_t i) {
      const transform inverse = s.instances[targets[i]].world_from_object.inverse();
      const std::uint32_t expected = expected_triangle(m, inverse, rays[i]);
      const tracer::hit& h = points[i].met;
      return expected == tracer::miss || (h.instance == targets[i] && h.triangle == expected);
    });
    // The cross product of edges is off by 5 u of their product, 6 u of the normal in an
    // equilateral triangle; the map's matrix by u and its sums by 3 u of their terms, which a
    // condition of |M| |M^-1| may stretch; making it a unit vector by 3 u.
    double worst = 0;
    for (std::uint64_t i = 0; i < count; ++i) {
      const tracer::hit& h = points[i].met;
      if (h.triangle == tracer::miss) continue;
      const transform& map = s.instances[h.instance].world_from_object;
      const auto p = corners(m, h.triangle);
      vec3d n = normalize(cross(map.vector(p[1] - p[0]), map.vector(p[2] - p[0])));
      if (dot(n, vec3d(direction_of(rays[i]))) > 0) n = -n;
      const double condition = norm(map) * norm(map.inverse());
      worst = std::max(worst, length(vec3d(points[i].geometric) - n) / (u * condition));
    }
    std::snprintf(what, sizeof what, "angle of the normal over u times the condition, scale %g",
                  size);
    l.report_figure(what, worst, 13, "");
  }
}

void seams(lab& l) {
  // A square [0, 1] x [-1, 1] twice, its left edge and its right edge meeting at x = 0.
  mesh m;
  add_loose(m, {0, -1, 0.25f}, {1, -1, 0}, {1, 1, 0});
  add_loose(m, {0, -1, 0.25f}, {1, 1, 0}, {0, 1, 0.25f});
  const auto at_seam = [&](scene s, const transform& whole, const std::string& what, bool is_goal) {
    for (instance& i : s.instances) i.world_from_object = whole * i.world_from_object;
    tracer::device_scene on = l.place(s);
    const auto make = [&](std::uint64_t i) {
      draw d(l.seed, i);
      // Origins on a grid of 2^-10, so that exact maps keep them exact.
      const auto grid = [&] { return float(std::int64_t(d.below(2048)) - 1024) * 0x1p-10f; };
      const float x = grid(), y = grid();
      const vec3d o = whole.point({x, y, 3});
      const vec3d to = whole.point({0, 0.9 * d.signed_uniform(), 0.25});
      return make_ray(vec3f(o), vec3f(to) - vec3f(o));
    };
    const std::uint64_t count = l.at_most(100000);
    trace_and_check(l, on, what, count, make,
                    [](std::uint64_t, const tracer::ray&, const tracer::hit& h) {
                      return h.triangle != tracer::miss;
                    });
    l.findings.back().is_goal = is_goal;
  };
  scene mirrored = scene_with(m);
  mirrored.instances.push_back({0, transform::scale({-1, 1, 1}), instance::own_materials});
  at_seam(mirrored, {}, "leaks, mirrored", true);
  at_seam(mirrored, transform::scale({4, 0.5, 1024}), "leaks, mirrored, powers of two", true);
  // The other square ends where this one begins.
  mesh left = m;
  for (vec3f& p : left.positions) p.z = 0.25f - p.z;
  scene moved = scene_with(m);
  moved.meshes.push_back(left);
  moved.instances.push_back({1, transform::translate({-1, 0, 0}), instance::own_materials});
  at_seam(moved, {}, "leaks, moved by a whole number", true);
  at_seam(moved, transform::translate({16, -8, 4}), "leaks, both moved by whole numbers", true);
  at_seam(mirrored, transform::rotate({1, 2, 3}, 40), "leaks, turned: the maps round (reported)",
          false);
  at_seam(mirrored, transform::translate({0.1, 0.2, 0.3}), "leaks, moved by 0.1 (reported)", false);
}

}  // namespace facet::study
