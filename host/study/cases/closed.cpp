// A closed mesh never leaks: a ray that starts inside meets it, whatever it is aimed at.
#include <array>
#include <string>

#include "study/cases/exact.hpp"
#include "study/cases/families.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

/// Where a ray leaves the inside of a mesh, and for where.
struct aim {
  vec3f origin, target;
};

bool is_hit(std::uint64_t, const tracer::ray&, const tracer::hit& h) {
  return h.triangle != tracer::miss;
}

/// Whole numbers below 2^22 around the middle of a mesh whose surface lies beyond 2^21.
vec3f grid_origin(draw& d) {
  const auto whole = [&] { return float(std::int64_t(d.below(1u << 21)) - (1 << 20)); };
  const float x = whole(), y = whole(), z = whole();
  return {x, y, z};
}

/// A noisy sphere with whole corners, multiples of 16 below 2^23: sixteenths of its edges are
/// whole, too, and so are directions from whole origins, below 2^24.
mesh grid_sphere() { return on_grid(noisy_sphere(4), 0x1p22, 16); }

vec3f corner(const mesh& m, draw& d) {
  return m.positions[m.indices[d.below(std::uint32_t(m.indices.size()))]];
}

/// A sixteenth of an edge, or any point of it, rounded.
vec3f on_edge(const mesh& m, draw& d) {
  const std::uint32_t triangle = d.below(std::uint32_t(m.triangle_count()));
  const int side = int(d.below(3));
  const vec3d a(m.position(triangle, side)), b(m.position(triangle, (side + 1) % 3));
  const bool is_exact = d.below(2) == 0;
  const double share = is_exact ? d.below(17) / 16.0 : d.uniform();
  return vec3f(a + (b - a) * share);
}

aim aim_at(const mesh& m, int kind, draw& d) {
  const vec3f o = grid_origin(d);
  return {o, kind == 0 ? corner(m, d) : on_edge(m, d)};
}

void closed_on_grid(lab& l, int kind, const char* what) {
  const scene s = scene_with(grid_sphere());
  const mesh& m = s.meshes[0];
  const auto make = [&](std::uint64_t i) {
    draw d(l.seed, i);
    const aim a = aim_at(m, kind, d);
    return make_ray(a.origin, a.target - a.origin);
  };
  tracer::device_scene on = l.place(s);
  trace_and_check(l, on, std::string("leaks, rays ") + what, l.rays, make, is_hit);
  // That the rays do meet the mesh is not taken for granted.
  count_failures(
      l, "rays that miss the mesh in whole numbers", l.at_most(300), [&](std::uint64_t i) {
        const tracer::ray r = make(i);
        const vec3f to = direction_of(r);
        if (std::rint(to.x) != to.x || std::rint(to.y) != to.y || std::rint(to.z) != to.z)
          return true;
        for (std::size_t t = 0; t < m.triangle_count(); ++t)
          if (grid_ray_meets(on_grid(origin_of(r)), on_grid(to),
                             {on_grid(m.position(t, 0)), on_grid(m.position(t, 1)),
                              on_grid(m.position(t, 2))}))
            return true;
        return false;
      });
}

}  // namespace

void closed_random(lab& l) {
  // Small triangles: about 1e-4 a side, seen from up to 0.2 away.
  constexpr double size = 0.1;
  mesh m = noisy_sphere(5);
  for (vec3f& p : m.positions) p = vec3f(vec3d(p) * size);
  const scene s = scene_with(std::move(m));
  tracer::device_scene on = l.place(s);
  const auto make = [&](std::uint64_t i) {
    draw d(l.seed, i);
    const vec3d o = d.in_cube() * (0.3 * size);
    return make_ray(vec3f(o), vec3f(d.direction()));
  };
  trace_and_check(l, on, "leaks, random rays", l.rays, make, is_hit);
}

void closed_vertices(lab& l) { closed_on_grid(l, 0, "at vertices"); }

void closed_edges(lab& l) { closed_on_grid(l, 1, "along edges"); }

void closed_moved(lab& l) {
  // The mesh's size, and how many sizes away from the origin it stands.
  constexpr std::array<std::array<double, 2>, 8> places{{{1e-6, 1e3},
                                                         {1e-6, 1e6},
                                                         {1e-3, 1e5},
                                                         {1, 1e3},
                                                         {1, 1e6},
                                                         {1e3, 1e4},
                                                         {1e6, 1e3},
                                                         {1e6, 1e6}}};
  // Few triangles: far away every box is as wide as its pad, and rays meet them all.
  const mesh unit = noisy_sphere(3);
  for (const auto& [size, away] : places) {
    const vec3d middle = vec3d(0.62, -0.49, 0.61) * (size * away);
    mesh m = unit;
    for (vec3f& p : m.positions) p = vec3f(vec3d(p) * size + middle);
    const scene s = scene_with(std::move(m));
    const mesh& placed = s.meshes[0];
    const auto make = [&, size_of = size](std::uint64_t i) {
      draw d(l.seed, i);
      const vec3f o(middle + d.in_cube() * (0.2 * size_of));
      const std::uint32_t kind = d.below(3);
      const vec3f target = kind == 0   ? vec3f(vec3d(o) + d.direction() * size_of)
                           : kind == 1 ? corner(placed, d)
                                       : on_edge(placed, d);
      return make_ray(o, target - o);
    };
    tracer::device_scene on = l.place(s);
    char what[80];
    std::snprintf(what, sizeof what, "leaks, size %g, %g sizes away", size, away);
    trace_and_check(l, on, what, l.rays / places.size(), make, is_hit);
  }
}

}  // namespace facet::study
