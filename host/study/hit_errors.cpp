#include "study/hit_errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>
#include <numbers>

#include "reference/geometry.hpp"
#include "reference/surface.hpp"
#include "scene/world_bounds.hpp"
#include "study/cases/lab.hpp"
#include "study/parallel.hpp"

namespace facet::study {
namespace {

template <class T>
reference::ray<T> as(const tracer::ray& r) {
  return {vec3<T>(origin_of(r)), T(r.tmin), vec3<T>(direction_of(r)), T(r.tmax)};
}

/// Floats in their order, as integers one apart. NaN lies beyond all.
std::int64_t place_of(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const auto size = std::int64_t(bits & 0x7fffffffu);
  return bits >> 31 ? -size : size;
}

std::uint64_t floats_between(float a, float b) {
  return std::uint64_t(std::abs(place_of(a) - place_of(b)));
}

bool is_same(const tracer::hit& a, const tracer::hit& b) {
  const auto same = [](float x, float y) {
    return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
  };
  return same(a.t, b.t) && same(a.u, b.u) && same(a.v, b.v) && a.instance == b.instance &&
         a.triangle == b.triangle;
}

double distance_to_segment(const vec3d& p, const vec3d& a, const vec3d& b) {
  const vec3d along = b - a;
  const double size = dot(along, along);
  const double s = size > 0 ? std::clamp(dot(p - a, along) / size, 0.0, 1.0) : 0;
  return length(p - (a + along * s));
}

double distance_to_triangle(const vec3d& p, const std::array<vec3d, 3>& c) {
  const vec3d normal = cross(c[1] - c[0], c[2] - c[0]);
  const double size = length(normal);
  bool is_above = size > 0;
  double nearest = INFINITY;
  for (std::size_t k = 0; k < 3; ++k) {
    const vec3d &a = c[k], &b = c[(k + 1) % 3];
    is_above = is_above && dot(cross(b - a, p - a), normal) >= 0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return is_above ? std::abs(dot(p - c[0], normal)) / size : nearest;
}

/// Two unit vectors across d and each other.
std::array<vec3d, 2> across(const vec3d& d) {
  const vec3d a = abs(d);
  const vec3d other = a.x <= a.y && a.x <= a.z ? vec3d{1, 0, 0}
                      : a.y <= a.z             ? vec3d{0, 1, 0}
                                               : vec3d{0, 0, 1};
  const vec3d first = normalize(cross(d, other));
  return {first, normalize(cross(d, first))};
}

void count_ulps(std::vector<std::uint64_t>& apart, hit_errors& e) {
  e.compared = apart.size();
  if (apart.empty()) return;
  std::sort(apart.begin(), apart.end());
  e.median_ulps = apart[apart.size() / 2];
  e.p99_ulps = apart[std::size_t(0.99 * double(apart.size() - 1))];
  e.most_ulps = apart.back();
  e.ulps.assign(1, 0);
  for (const std::uint64_t u : apart) {
    const auto bin = u == 0 ? 0 : std::size_t(std::bit_width(u - 1)) + 1;
    if (bin >= e.ulps.size()) e.ulps.resize(bin + 1);
    ++e.ulps[bin];
  }
}

}  // namespace

ray_set eye_rays(const scene& s, std::uint32_t width, std::uint32_t height) {
  const reference::film<float> film(frame_of(s.view, width, height));
  const auto n = float(s.samples);
  ray_set set{"eye", {}};
  set.rays.reserve(std::size_t(width) * height * s.samples * s.samples);
  for (std::uint32_t y = 0; y < height; ++y)
    for (std::uint32_t x = 0; x < width; ++x)
      for (std::uint32_t j = 0; j < s.samples; ++j)
        for (std::uint32_t i = 0; i < s.samples; ++i) {
          const auto r =
              film.through(float(x) + (float(i) + 0.5f) / n, float(y) + (float(j) + 0.5f) / n);
          set.rays.push_back(make_ray(r.origin, r.direction));
        }
  return set;
}

ray_set bounce_rays(const scene& s, const ray_set& eye, std::uint64_t seed, unsigned threads) {
  const reference::geometry<float> world(s);
  std::vector<tracer::ray> rays(eye.rays.size());
  std::vector<std::array<std::uint32_t, 2>> from(rays.size(), {tracer::miss, tracer::miss});
  in_parallel(threads, rays.size(), [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t i = first; i < last; ++i) {
      const reference::ray<float> r = as<float>(eye.rays[i]);
      const reference::hit<float> h = world.closest(r, reference::road::tree);
      if (!h) continue;
      const reference::surface<float> at = reference::surface_at(world, h, r.direction);
      const vec3d sphere = draw(seed, i).direction() * 0.9999;
      const vec3f direction(normalize(vec3d(at.geometric) + sphere));
      rays[i] = make_ray(at.near_side(), direction);
      from[i] = {h.instance, h.triangle};
    }
  });
  ray_set set{"bounce", {}};
  for (std::size_t i = 0; i < rays.size(); ++i)
    if (from[i][1] != tracer::miss) set.rays.push_back(rays[i]), set.from.push_back(from[i]);
  return set;
}

double sideways_bound(const box3<double>& world, const tracer::ray& r) {
  if (world.empty()) return 0;
  const vec3d reach = abs(vec3d(origin_of(r))) + max(abs(world.lo), abs(world.hi));
  return sideways_units * 0x1p-24 * std::max(std::max(reach.x, reach.y), reach.z);
}

hit_oracle::hit_oracle(const scene& s, const reference::tracer<double>& exact, unsigned threads,
                       std::function<void()> check)
    : scene_(s),
      exact_(exact),
      threads_(threads),
      check_(std::move(check)),
      world_(world_box<double>(s)) {}

std::vector<reference::hit<double>> hit_oracle::trace(const ray_set& r) const {
  std::vector<reference::hit<double>> hits(r.rays.size());
  in_parallel(threads_, hits.size(), [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t i = first; i < last; ++i) {
      if (check_ && i % 1024 == 0) check_();
      hits[i] = exact_.closest(as<double>(r.rays[i]));
    }
  });
  return hits;
}

/// Of a point in the world to the triangle that a hit names.
double hit_oracle::distance(const vec3d& p, const tracer::hit& to) const {
  const instance& i = scene_.instances[to.instance];
  const mesh& m = scene_.meshes[i.mesh];
  const reference::affine<double> place(i.world_from_object);
  std::array<vec3d, 3> corners;
  for (std::size_t k = 0; k < 3; ++k)
    corners[k] = place.point(vec3d(m.position(to.triangle, int(k))));
  return distance_to_triangle(p, corners);
}

hit_oracle::verdict hit_oracle::judge(const ray_set& r, std::size_t i,
                                      const reference::hit<double>& expected,
                                      const tracer::hit& found) const {
  const bool is_hit = found.triangle != tracer::miss;
  if (expected.instance == found.instance && expected.triangle == found.triangle)
    return verdict::right;
  if (is_hit && !r.from.empty() && r.from[i][0] == found.instance && r.from[i][1] == found.triangle)
    return verdict::self_hit;
  const double bound = sideways_bound(world_, r.rays[i]);
  const reference::ray<double> ray = as<double>(r.rays[i]);
  const auto is_at = [&](const reference::hit<double>& h, const vec3d& origin) {
    return distance(origin + ray.direction * h.t, found) <= bound;
  };
  if (is_hit && expected && is_at(expected, ray.origin)) return verdict::tie;
  const auto [a, b] = across(normalize(ray.direction));
  for (const double step : {bound / 64, bound / 16, bound / 4, bound})
    for (int k = 0; k < 8; ++k) {
      const double angle = k * std::numbers::pi / 4;
      reference::ray<double> moved = ray;
      moved.origin = ray.origin + (a * std::cos(angle) + b * std::sin(angle)) * step;
      const reference::hit<double> h = exact_.closest(moved);
      if (is_hit ? h && is_at(h, moved.origin) : !h) return verdict::silhouette;
    }
  return verdict::error;
}

hit_errors hit_oracle::judge(const ray_set& r, std::span<const reference::hit<double>> expected,
                             std::span<const tracer::hit> found,
                             std::span<const tracer::hit> strict) const {
  hit_errors all;
  all.rays = r.rays.size();
  std::vector<std::uint64_t> apart;
  std::mutex mutex;
  in_parallel(threads_, r.rays.size(), [&](std::uint64_t first, std::uint64_t last) {
    hit_errors part;
    std::vector<std::uint64_t> ulps;
    for (std::uint64_t i = first; i < last; ++i) {
      if (check_ && i % 1024 == 0) check_();
      part.other_bits += !is_same(found[i], strict[i]);
      switch (judge(r, i, expected[i], found[i])) {
        case verdict::right:
          if (expected[i]) ulps.push_back(floats_between(found[i].t, float(expected[i].t)));
          break;
        case verdict::tie:
          ++part.ties;
          break;
        case verdict::silhouette:
          ++part.silhouettes;
          break;
        case verdict::self_hit:
          ++part.self_hits;
          [[fallthrough]];
        case verdict::error:
          ++part.errors;
          part.first_errors.push_back(i);
          break;
      }
    }
    const std::lock_guard lock(mutex);
    all.ties += part.ties, all.silhouettes += part.silhouettes, all.errors += part.errors;
    all.self_hits += part.self_hits, all.other_bits += part.other_bits;
    apart.insert(apart.end(), ulps.begin(), ulps.end());
    all.first_errors.insert(all.first_errors.end(), part.first_errors.begin(),
                            part.first_errors.end());
  });
  std::sort(all.first_errors.begin(), all.first_errors.end());
  if (all.first_errors.size() > 8) all.first_errors.resize(8);
  count_ulps(apart, all);
  return all;
}

}  // namespace facet::study
