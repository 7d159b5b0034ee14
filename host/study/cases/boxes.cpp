// Slabs and nodes: zeros in directions, boxes without a thickness, coordinates of any size.
#include <cmath>

#include "reference/tracer.hpp"
#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/oracle.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

/// 0, -0 or a power of two: with whole origins and corners every step of the test is exact.
float plain_number(draw& d) {
  constexpr float numbers[] = {0.0f, -0.0f, 0.0f, -0.0f, 1, -1, 2, -2, 4, -4};
  return numbers[d.below(10)];
}

/// At least one component is 0, at least one is not.
vec3f plain_direction(draw& d) {
  vec3f v{plain_number(d), plain_number(d), plain_number(d)};
  v[int(d.below(3))] = d.below(2) ? 0.0f : -0.0f;
  if (v.x == 0 && v.y == 0 && v.z == 0) v[int(d.below(3))] = d.below(2) ? 1.0f : -1.0f;
  return v;
}

/// From outside, faces, edges, corners and insides of what stands between 0 and 8.
vec3f plain_origin(draw& d) {
  const auto whole = [&] { return float(d.below(12)) - 2; };
  const float x = whole(), y = whole(), z = whole();
  return {x, y, z};
}

std::vector<std::array<grid_point, 3>> grid_triangles(const mesh& m) {
  std::vector<std::array<grid_point, 3>> all;
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    all.push_back(
        {on_grid(m.position(t, 0)), on_grid(m.position(t, 1)), on_grid(m.position(t, 2))});
  return all;
}

/// Hit or miss as in whole numbers; what a hit holds is finite and the float reference's.
void against_grid(lab& l, const scene& s, std::uint64_t count) {
  const auto triangles = grid_triangles(s.meshes[0]);
  const reference::tracer<float> serial(s);
  tracer::device_scene on = l.place(s);
  trace_and_check(
      l, on, "wrong hit or miss, NaN, or other bits", count,
      [&](std::uint64_t i) {
        draw d(l.seed, i);
        const vec3f o = plain_origin(d);
        return make_ray(o, plain_direction(d));
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        const grid_point o = on_grid(origin_of(r)), to = on_grid(direction_of(r));
        const bool is_met = std::any_of(triangles.begin(), triangles.end(),
                                        [&](const auto& p) { return grid_ray_meets(o, to, p); });
        return is_met == (h.triangle != tracer::miss) && same_hit(h, serial.closest(serial_ray(r)));
      });
}

void add_box(mesh& m, vec3f lo, vec3f hi) {
  const mesh box = generate("box", {{"size", 2}});
  const auto first = std::uint32_t(m.positions.size());
  for (const vec3f& p : box.positions)
    m.positions.push_back({p.x < 0 ? lo.x : hi.x, p.y < 0 ? lo.y : hi.y, p.z < 0 ? lo.z : hi.z});
  for (const std::uint32_t i : box.indices) m.indices.push_back(first + i);
}

/// A rectangle across `axis` at `at`, from `lo` to `hi` in the other two.
void add_plate(mesh& m, int axis, float at, vec3f lo, vec3f hi) {
  lo[axis] = hi[axis] = at;
  vec3f b = lo, c = hi;
  b[(axis + 1) % 3] = hi[(axis + 1) % 3];
  c[(axis + 1) % 3] = lo[(axis + 1) % 3];
  add_loose(m, lo, b, hi);
  add_loose(m, lo, hi, c);
}

}  // namespace

void zero_directions(lab& l) {
  // Eight boxes, with gaps, touching along faces, edges and corners.
  mesh m;
  for (int k = 0; k < 8; ++k) {
    const vec3f lo{float(k & 1 ? 4 : 0), float(k & 2 ? 5 : 1), float(k & 4 ? 4 : 0)};
    add_box(m, lo, lo + vec3f(4, k % 3 == 0 ? 4.0f : 3.0f, k % 2 == 0 ? 4.0f : 2.0f));
  }
  against_grid(l, scene_with(std::move(m)), l.rays);
}

void flat_boxes(lab& l) {
  mesh m;
  for (int k = 0; k < 24; ++k) {
    draw d(l.seed, std::uint64_t(k));
    const vec3f lo{float(d.below(5)), float(d.below(5)), float(d.below(5))};
    add_plate(
        m, k % 3, float(d.below(9)), lo,
        lo + vec3f(1.0f + float(d.below(4)), 1.0f + float(d.below(4)), 1.0f + float(d.below(4))));
  }
  against_grid(l, scene_with(std::move(m)), l.at_most(1000000));
}

void extreme_nodes(lab& l) {
  // Triangles from 2^-50 to 2^50 in size and place, a third of them flat along an axis, so that a
  // node's children differ in extent by any ratio.
  mesh m;
  for (std::uint32_t k = 0; k < 600; ++k) {
    draw d(l.seed, k);
    const double size = std::ldexp(1.0, int(d.below(101)) - 50),
                 away = std::ldexp(1.0, int(d.below(101)) - 50);
    vec3d p[3];
    const vec3d middle = d.in_cube() * away;
    for (vec3d& c : p) c = middle + d.in_cube() * size;
    if (k % 3 == 0) p[1][int(k / 3 % 3)] = p[2][int(k / 3 % 3)] = p[0][int(k / 3 % 3)];
    add_loose(m, vec3f(p[0]), vec3f(p[1]), vec3f(p[2]));
  }
  const scene s = scene_with(std::move(m));
  const mesh& all = s.meshes[0];
  const reference::tracer<float> serial(s);
  tracer::device_scene on = l.place(s);
  trace_and_check(
      l, on, "other bits than brute force", l.at_most(20000),
      [&](std::uint64_t i) {
        draw d(l.seed + 1, i);
        const std::uint32_t t = d.below(std::uint32_t(all.triangle_count()));
        const vec3d at = (vec3d(all.position(t, 0)) + vec3d(all.position(t, 1)) * d.uniform() +
                          vec3d(all.position(t, 2)) * d.uniform()) /
                         3.0;
        const vec3f o(at + d.in_cube() * std::ldexp(1.0, int(d.below(61)) - 30));
        return make_ray(o, vec3f(normalize(vec3d(all.position(t, int(d.below(3)))) - vec3d(o))));
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        return same_hit(h, serial.closest_brute(serial_ray(r)));
      });
}

}  // namespace facet::study
