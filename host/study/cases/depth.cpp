// Trees of any shape and size: equal codes, geometric series, ten million triangles.
#include <bit>
#include <cmath>
#include <string>

#include "reference/tracer.hpp"
#include "reference/triangle.hpp"
#include "study/cases/families.hpp"
#include "study/cases/oracle.hpp"
#include "study/cases/shapes.hpp"

namespace facet::study {
namespace {

std::uint32_t depth_of(tracer::device_scene& on) {
  tracer::statistics s;
  on.trace({}, false, 1, &s);
  return s.tree_depth;
}

unsigned log2_up(std::uint64_t n) { return unsigned(std::bit_width(n - 1)); }

/// Their boxes differ and have one centre, the origin.
mesh concentric(std::uint32_t n, std::uint64_t seed) {
  mesh m;
  for (std::uint32_t k = 0; k < n; ++k) {
    draw d(seed, k);
    const vec3f a(d.direction());
    add_loose(m, a, -a,
              vec3f(vec3d(std::abs(a.x), std::abs(a.y), std::abs(a.z)) * d.signed_uniform()));
  }
  return m;
}

/// Rays from around the unit cube into it; few of them pass beside everything.
tracer::ray inward_ray(std::uint64_t seed, std::uint64_t i) {
  draw d(seed, i);
  const vec3f o(d.direction() * 3.0);
  return make_ray(o, vec3f(d.in_cube() * 0.7) - o);
}

/// A height field over the plane, one unit a cell: the two triangles under a point are known.
mesh height_field(std::uint32_t cells) {
  mesh m;
  const auto row = cells + 1;
  m.positions.reserve(std::size_t(row) * row);
  m.indices.reserve(6 * std::size_t(cells) * cells);
  for (std::uint32_t j = 0; j < row; ++j)
    for (std::uint32_t i = 0; i < row; ++i) {
      draw d(7, std::uint64_t(j) * row + i);
      m.positions.push_back({float(i), float(d.uniform()), float(j)});
    }
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * row + i, b = a + 1, c = a + row, e = c + 1;
      m.indices.insert(m.indices.end(), {a, c, b, b, c, e});
    }
  return m;
}

/// As many cells a side as `bytes` of device memory hold with their tree (about 420 bytes a
/// triangle at the peak; tracer/tree.cpp), and at most enough for the corners to pass 2^31 bytes.
std::uint32_t field_cells(const lab& l, std::uint64_t bytes) {
  const std::uint64_t asked = l.rays >= 100000000 ? 50000000 : l.rays >= 1000000 ? 10000000 : 20000;
  const std::uint64_t triangles = std::min(asked, bytes / 640);
  return std::uint32_t(std::sqrt(double(triangles) / 2));
}

void large_field(lab& l) {
  const runtime::device device = l.queue.get_device();
  // A single buffer, 128 bytes a triangle, may be at most as large as the device says.
  const std::uint64_t bytes =
      std::min<std::uint64_t>(device.global_mem_size(), 5 * device.max_mem_alloc_size());
  const std::uint32_t cells = field_cells(l, bytes);
  const scene s = scene_with(height_field(cells));
  const mesh& field = s.meshes[0];
  tracer::device_scene on = l.place(s);
  const auto triangles = double(field.triangle_count());
  l.note_figure("triangles", triangles, "");
  l.note_figure("bytes of corners", 48 * triangles, "");
  l.report_figure("depth", depth_of(on), 63 + log2_up(field.triangle_count()), "");
  // Straight down: brute force over the cells around is brute force over all.
  trace_and_check(
      l, on, "other bits than brute force, straight down", l.at_most(10000),
      [&](std::uint64_t i) {
        draw d(l.seed, i);
        return make_ray({float(d.uniform() * cells), 2, float(d.uniform() * cells)}, {0, -1, 0});
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        const reference::space<float> space(origin_of(r), direction_of(r),
                                            vec3f(float(cells), 1, float(cells)));
        reference::hit<float> best;
        const auto cell = [&](float x) { return std::int64_t(std::floor(x)); };
        for (std::int64_t j = cell(r.origin[2]) - 1; j <= cell(r.origin[2]) + 1; ++j)
          for (std::int64_t i = cell(r.origin[0]) - 1; i <= cell(r.origin[0]) + 1; ++i) {
            if (i < 0 || j < 0 || i >= cells || j >= cells) continue;
            for (std::uint32_t k = 0; k < 2; ++k) {
              const auto t = std::uint32_t(2 * (j * cells + i)) + k;
              const reference::corners<float> p{field.position(t, 0), field.position(t, 1),
                                                field.position(t, 2)};
              const auto found = reference::triangle_test<float>(space, p).accept({}, 0, INFINITY);
              if (!found) continue;
              const reference::hit<float> one{found->t, found->u, found->v, 0, t};
              if (one < best) best = one;
            }
          }
        return same_hit(h, best);
      });
}

void many_instances(lab& l) {
  const std::uint64_t asked = l.rays >= 1000000 ? 1000000 : l.rays;
  const auto side = std::uint32_t(std::lround(std::cbrt(double(asked))));
  scene s = scene_with(generate("box", {{"size", 0.5}}));
  s.instances.clear();
  for (std::uint32_t k = 0; k < side * side * side; ++k)
    s.instances.push_back(
        {0,
         transform::translate({double(k % side), double(k / side % side), double(k / side / side)}),
         instance::own_materials});
  tracer::device_scene on = l.place(s);
  l.note_figure("instances", double(s.instances.size()), "");
  l.report_figure("depth, instances and mesh", depth_of(on),
                  2 * 63 + log2_up(s.instances.size()) + 4, "");
  // From halfway to a neighbour to the middle of a box: only that box is in reach.
  const auto target = [&](std::uint64_t i) {
    draw d(l.seed, i);
    return d.below(side * side * side);
  };
  trace_and_check(
      l, on, "wrong instance", l.at_most(100000),
      [&](std::uint64_t i) {
        const std::uint32_t k = target(i);
        draw d(l.seed + 1, i);
        const vec3f middle{float(k % side), float(k / side % side), float(k / side / side)};
        const vec3f o(vec3d(middle) + d.direction() * 0.49);
        return make_ray(o, middle - o, 0, 1);
      },
      [&](std::uint64_t i, const tracer::ray&, const tracer::hit& h) {
        return h.triangle != tracer::miss && h.instance == target(i);
      });
}

}  // namespace

void equal_codes(lab& l) {
  std::vector<std::uint32_t> sizes{1, 2, 3, 16, 64, 1000, 4096, 100000};
  if (l.rays >= 1000000) sizes.push_back(1000000);
  // That mistake makes a tree of up to 28 triangles only; more would not be joined at all.
  if (l.wrong) sizes = {16};
  for (const std::uint32_t n : sizes) {
    const scene s = scene_with(concentric(n, l.seed));
    const reference::tracer<float> serial(s);
    for (const tracer::tree_kind tree : {tracer::tree_kind::levels, tracer::tree_kind::binned}) {
      tracer::options o = l.options;
      o.tree = tree;
      tracer::device_scene on = l.place(s, o);
      // The bound of binned trees: 48 levels by cost, then one a bit of an index, and 15 at the
      // bottom (cl/bins.h: TOP_SWEPT_DEPTH; cl/bottom.cl).
      const std::string name = std::string(tracer::word_of(tree)) + ", " + std::to_string(n);
      l.report_figure("depth of " + name, depth_of(on),
                      tree == tracer::tree_kind::levels ? log2_up(n) : 63 + log2_up(n), "");
      if (n > 4096) continue;
      trace_and_check(
          l, on, "other bits than brute force, " + name, l.at_most(2000),
          [&](std::uint64_t i) { return inward_ray(l.seed, i); },
          [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
            return same_hit(h, serial.closest_brute(serial_ray(r)));
          });
    }
  }
}

void geometric_series(lab& l) {
  // Each triangle half as large and half as far as the one before, in three directions.
  mesh m;
  for (int k = 0; k < 180; ++k) {
    const double size = std::ldexp(1.0, 50 - k / 3);
    vec3f a, b, c;
    a[k % 3] = float(size);
    b = c = a;
    b[(k + 1) % 3] = float(size * 0.25);
    c[(k + 2) % 3] = float(size * 0.25);
    add_loose(m, a, b, c);
  }
  const scene s = scene_with(std::move(m));
  const mesh& series = s.meshes[0];
  tracer::device_scene on = l.place(s);
  l.report_figure("depth", depth_of(on), 63 + log2_up(series.triangle_count()), "");
  const reference::tracer<float> serial(s);
  trace_and_check(
      l, on, "other bits than brute force", l.at_most(20000),
      [&](std::uint64_t i) {
        draw d(l.seed, i);
        const std::uint32_t t = d.below(std::uint32_t(series.triangle_count()));
        const vec3d at(series.position(t, 0)), side(series.position(t, 1));
        const vec3f o(at * (1.5 + d.uniform()));
        return make_ray(o, vec3f(normalize(at + (side - at) * d.uniform() - vec3d(o))));
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        return same_hit(h, serial.closest_brute(serial_ray(r)));
      });
}

void many(lab& l) {
  large_field(l);
  many_instances(l);
}

}  // namespace facet::study
