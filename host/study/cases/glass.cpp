// Glass: the critical angle, media within one another, and crossings counted once.
#include <algorithm>
#include <cmath>
#include <string>

#include "reference/tracer.hpp"
#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/glass_scenes.hpp"
#include "study/cases/oracle.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

constexpr double u = 0x1p-24;
constexpr float attenuation_distance = 2;

material tinted(const char* name, float index, vec3f kt, float distance) {
  material m;
  m.name = name;
  m.Kd = {0, 0, 0};
  m.Kt = kt;
  m.Ni = index;
  m.attenuation_distance = distance;
  return m;
}

/// How far the way to a crossing may be off: 25 u R / sin of the angle, R the largest |corner -
/// origin| (case 6).
double distance_error(const mesh& m, std::uint32_t triangle, vec3d o, vec3d d) {
  const vec3d p[3] = {vec3d(m.position(triangle, 0)), vec3d(m.position(triangle, 1)),
                      vec3d(m.position(triangle, 2))};
  const double sine = std::abs(dot(normalize(cross(p[1] - p[0], p[2] - p[0])), d));
  double reach = 0;
  for (const vec3d& c : p)
    for (int i = 0; i < 3; ++i) reach = std::max(reach, std::abs(c[i] - o[i]));
  return 25 * u * reach / sine;
}

bool same_triangles(const std::vector<reference::crossing<double>>& a,
                    const std::vector<reference::crossing<float>>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
    return x.triangle == y.triangle && x.front == y.front;
  });
}

void crossings_of(lab& l, const std::string& name, mesh closed, std::uint64_t count) {
  scene s = scene_with(std::move(closed));
  s.materials[0] = tinted("glass", 1.5f, {0.9f, 0.7f, 0.5f}, attenuation_distance);
  const mesh& m = s.meshes[0];
  const reference::tracer<double> serial(s);
  const reference::tracer<float> in_float(s);
  struct way {
    const char* name;
    tracer::device_scene on;
  };
  std::vector<way> ways;
  tracer::options o = l.options;
  ways.push_back({"levels", l.place(s, o)});
  o.geometry = tracer::geometry_kind::image;
  ways.push_back({"images", l.place(s, o)});
  // Brute force, for a share of the rays.
  o.geometry = tracer::geometry_kind::buffer;
  o.tree = tracer::tree_kind::none;
  const std::uint64_t brute = std::min<std::uint64_t>(count, 4000000 / m.triangle_count());
  tracer::device_scene each = l.place(s, o);

  finding miscounts, bits, analytic;
  miscounts.what = name + ": entries differ from exits";
  bits.what = name + ": other bits of T by another way";
  analytic.what = name + ": T differs from the analytic one";
  const auto note = [](finding& f, std::uint64_t i) {
    if (f.failed < f.first.size()) f.first[f.failed] = i;
    ++f.failed;
  };
  in_batches(l, count, [&](std::uint64_t first, std::uint64_t size) {
    std::vector<tracer::ray> rays(size);
    in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
      for (std::uint64_t i = a; i < b; ++i) {
        draw d(l.seed, first + i);
        const vec3d from = d.direction() * 6.0;
        const std::uint32_t t = d.below(std::uint32_t(m.triangle_count()));
        const int side = int(d.below(3));
        const vec3d p(m.position(t, side)), q(m.position(t, (side + 1) % 3));
        const vec3f target(d.below(2) ? p : p + (q - p) * d.uniform());
        rays[i] = make_ray(vec3f(from), vec3f(normalize(vec3d(target) - vec3d(vec3f(from)))));
      }
    });
    const auto passed = ways[0].on.passages(rays);
    for (std::uint64_t i = 0; i < size; ++i)
      if (passed[i].entries != passed[i].exits || passed[i].is_dark) note(miscounts, first + i);
    miscounts.tried += size;
    const auto compare = [&](tracer::device_scene& on, std::uint64_t part) {
      const auto other = on.passages(std::span(rays).first(part));
      for (std::uint64_t i = 0; i < part; ++i)
        if (other[i].transmittance != passed[i].transmittance ||
            other[i].entries != passed[i].entries)
          note(bits, first + i);
      bits.tried += part;
    };
    compare(ways[1].on, size);
    if (first < brute) compare(each, std::min(size, brute - first));
    // Where double crosses the same triangles, T follows from the ways inside.
    if (first >= 1000000) return;
    std::vector<int> verdict(size, 0);  // 0 as it should be, 1 wrong, 2 not comparable
    in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
      for (std::uint64_t i = a; i < b; ++i) {
        const auto found = serial.crossings(double_ray(rays[i]));
        if (!same_triangles(found, in_float.crossings(serial_ray(rays[i])))) {
          verdict[i] = 2;
          continue;
        }
        double inside = 0, slack = 0;
        for (const auto& c : found) {
          inside += c.front ? -c.t : c.t;
          slack += distance_error(m, c.triangle, vec3d(origin_of(rays[i])),
                                  vec3d(direction_of(rays[i])));
        }
        for (int c = 0; c < 3; ++c) {
          const double kt = double(s.materials[0].Kt[c]);
          const double expected =
              std::pow(kt, double(found.size()) + inside / attenuation_distance);
          // The depth is at most 20; each term of it is rounded by u, and so is its exponential.
          const double relative = -std::log(kt) / attenuation_distance * slack + 20 * 4 * u;
          const double error = std::abs(double(passed[i].transmittance[c]) - expected);
          if (!(error <= std::expm1(relative) * expected)) verdict[i] = 1;
        }
      }
    });
    for (std::uint64_t i = 0; i < size; ++i) {
      analytic.tried += verdict[i] != 2;
      if (verdict[i] == 1) note(analytic, first + i);
    }
  });
  l.report(miscounts);
  l.report(bits);
  l.report_figure(name + ": share that crosses other triangles in double",
                  1 - double(analytic.tried) / double(std::min<std::uint64_t>(count, 1000000)), 0.9,
                  "");
  l.report(analytic);
}

}  // namespace

void critical_angle(lab& l) {
  // A slab; rays from inside it, whose sine is a few ulps from 1 / Ni.
  scene s = scene_with(generate("box", {{"size", 2}}));
  s.materials[0] = tinted("glass", 1.5f, {0.9f, 0.8f, 0.7f}, 1.0f);
  s.materials[0].Kr = {0.05f, 0.05f, 0.05f};
  const std::uint64_t count = l.at_most(20000);
  for (const float index : {1.0001f, 1.33f, 1.5f, 2.42f}) {
    s.materials[0].Ni = index;
    std::vector<tracer::ray> rays;
    std::vector<double> beyond;  // the sine over the critical one, less 1
    for (std::uint64_t i = 0; i < count; ++i) {
      draw d(l.seed, i);
      const double critical = 1 / double(index);
      const double sine = std::min(1.0, critical * (1 + (double(d.below(129)) - 64) * u));
      const double angle = 6.283185307179586 * d.uniform();
      const vec3f way(
          vec3d(sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1 - sine * sine)));
      rays.push_back(make_ray({0, 0, 0.99f}, way));
      const vec3d unit = normalize(vec3d(way));
      beyond.push_back(std::hypot(unit.x, unit.y) * double(index) - 1);
    }
    tracer::device_scene on = l.place(s);
    const auto points = on.surfaces(rays);
    if (l.on_batch) l.on_batch();
    count_failures(l, "NaN, weight beyond [0, 1] or wrong side, index " + std::to_string(index),
                   count, [&](std::uint64_t i) {
                     const tracer::surface_point& at = points[i];
                     if (at.met.triangle == tracer::miss || !at.reflects) return false;
                     const vec3f &r = at.reflected, &w = at.reflected_weight;
                     if (!is_finite(r) || std::abs(length(vec3d(r)) - 1) > 4 * u || !(r.z < 0))
                       return false;
                     if (!(w.x >= 0 && w.x <= 1 && w.y >= 0 && w.y <= 1 && w.z >= 0 && w.z <= 1))
                       return false;
                     if (!at.refracts) return true;
                     const vec3f& t = at.refracted;
                     return is_finite(t) && std::abs(length(vec3d(t)) - 1) <= 4 * u && t.z > 0;
                   });
    // 1 - eta^2 (1 - cos^2) loses 12 u: cos^2 is off by 4 u, the direction's length by 2 u, twice,
    // eta^2 by 2 u and the rest by 2 u. Farther from the critical angle than that the choice is
    // Snell's.
    count_failures(
        l, "refracts where Snell does not, or not where it does, index " + std::to_string(index),
        count, [&](std::uint64_t i) {
          if (std::abs(beyond[i]) < 12 * u) return true;
          return points[i].refracts == (beyond[i] < 0);
        });
  }
}

void inside_glass(lab& l) {
  const auto side = std::uint32_t(std::sqrt(double(l.at_most(40000))));
  for (const glass_scene& g : glass_scenes()) {
    const scene s = g.make();
    tracer::device_scene on = l.place(s);
    tracer::statistics stats;
    const picture p = on.render(side, side, 8, &stats);
    if (l.on_batch) l.on_batch();
    const camera_frame f = frame_of(s.view, side, side);
    double worst = 0;
    for (std::uint32_t y = 0; y < side; ++y)
      for (std::uint32_t x = 0; x < side; ++x) {
        const vec3d way = normalize(f.corner + f.dx * (x + 0.5) + f.dy * (y + 0.5));
        const vec3d expected = g.radiance(s, way);
        for (int c = 0; c < 3; ++c) {
          const double found = double(p.at(x, y)[c]);
          const double error = std::abs(found - expected[c]) / expected[c];
          worst = error <= worst ? worst : error;  // a NaN stays
        }
      }
    l.report_figure(std::string("relative error, ") + g.name, worst, 1e-5, "");
    l.report_figure(std::string("media forgotten, ") + g.name, double(stats.crowded), 0, "");
  }
}

void glass_crossings(lab& l) {
  const std::uint64_t share = l.rays / 3;
  crossings_of(l, "bevelled box", bevelled_box(1, 0.05f), share);
  crossings_of(l, "icosphere", generate("icosphere", {{"radius", 1}, {"subdivisions", 4}}), share);
  crossings_of(l, "noisy sphere", noisy_sphere(4), l.rays - 2 * share);
}

}  // namespace facet::study
