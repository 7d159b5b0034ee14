// The same hit whatever the order in which triangles are met: duplicates, every way to trace, few
// triangles.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "reference/tracer.hpp"
#include "study/cases/families.hpp"
#include "study/cases/oracle.hpp"
#include "study/cases/shapes.hpp"
#include "study/kernel_edits.hpp"
#include "tracer/features.hpp"

namespace facet::study {
namespace {

using tracer::geometry_kind;
using tracer::layout_kind;
using tracer::tree_kind;

struct way {
  std::string name;
  tracer::options options;
  bool in_packets = false;  ///< the rays come in an order in which they can go together
};

/// The layout that the device does not choose by itself.
layout_kind other_layout(const lab& l) {
  return l.queue.get_device().is_gpu() ? layout_kind::wide : layout_kind::narrow;
}

/// Trees, how and where geometry lies, three work-groups, features left out or not.
std::vector<way> ways(const lab& l, const scene& s, bool with_brute_force) {
  std::vector<way> all;
  const auto add = [&](std::string name, tree_kind tree, geometry_kind geometry, std::uint32_t w,
                       std::uint32_t h, bool every_feature) {
    tracer::options o = l.options;
    o.tree = tree;
    o.geometry = geometry;
    o.group_width = w;
    o.group_height = h;
    o.all_features = every_feature;
    all.push_back({std::move(name), std::move(o)});
  };
  add("binned, buffer, packets", tree_kind::binned, geometry_kind::buffer, 0, 0, false);
  all.back().options.layout = layout_kind::wide;
  all.back().options.packets = tracer::packet_kind::on;
  all.back().options.compiler_flags +=
      " -DFACET_PACKET_WIDTH=1e30f";  // however far apart they start
  all.back().in_packets = true;
  for (const tree_kind tree : {tree_kind::binned, tree_kind::levels}) {
    const std::string name = tracer::word_of(tree);
    add(name + ", buffer, 64", tree, geometry_kind::buffer, 0, 0, false);
    add(name + ", buffer, the other layout", tree, geometry_kind::buffer, 0, 0, false);
    all.back().options.layout = other_layout(l);
    add(name + ", image, 64", tree, geometry_kind::image, 0, 0, false);
  }
  // For CPUs, and for one mesh in place.
  if (!l.queue.get_device().is_gpu() && !tracer::features::of(s).instances) {
    add("binned, buffer, streams", tree_kind::binned, geometry_kind::buffer, 0, 0, false);
    all.back().options.layout = layout_kind::wide;
    all.back().options.packets = tracer::packet_kind::on;
    all.back().options.streams = tracer::stream_kind::on;
  }
  add("binned, buffer, refilled", tree_kind::binned, geometry_kind::buffer, 0, 0, false);
  all.back().options.layout = layout_kind::narrow;
  all.back().options.refill = tracer::refill_kind::on;
  add("binned, buffer, 1", tree_kind::binned, geometry_kind::buffer, 1, 1, false);
  add("binned, buffer, 16x16", tree_kind::binned, geometry_kind::buffer, 16, 16, false);
  add("binned, buffer, all features", tree_kind::binned, geometry_kind::buffer, 0, 0, true);
  // As triangle.h says, that is sure to change nothing where it is left out.
  for (const layout_kind layout : {layout_kind::automatic, other_layout(l)}) {
    add("binned, buffer, t always held", tree_kind::binned, geometry_kind::buffer, 0, 0, false);
    all.back().options.layout = layout;
    all.back().options.edits = always_held();
  }
  if (with_brute_force) {
    add("none, buffer, 64", tree_kind::none, geometry_kind::buffer, 0, 0, false);
    add("none, buffer, the other layout", tree_kind::none, geometry_kind::buffer, 0, 0, false);
    all.back().options.layout = other_layout(l);
    add("none, image, 32", tree_kind::none, geometry_kind::image, 32, 1, true);
  }
  return all;
}

mesh random_triangles(std::uint32_t n, std::uint64_t seed) {
  mesh m;
  for (std::uint32_t k = 0; k < n; ++k) {
    draw d(seed, k);
    const vec3d middle = d.in_cube();
    add_loose(m, vec3f(middle + d.in_cube() * 0.3), vec3f(middle + d.in_cube() * 0.3),
              vec3f(middle + d.in_cube() * 0.3));
  }
  return m;
}

/// Copies of two meshes, turned, stretched, sheared, mirrored, tiny and large.
scene many_places(std::uint64_t seed) {
  scene s = scene_with(generate("icosphere", {{"radius", 0.5}, {"subdivisions", 3}}));
  s.meshes.push_back(random_triangles(60, seed));
  s.instances.clear();
  for (std::uint32_t k = 0; k < 30; ++k) {
    draw d(seed, k);
    transform shear;
    shear.row[0][1] = d.signed_uniform();
    const double size = k % 5 == 0 ? 1e-2 : k % 7 == 0 ? 3 : 0.4;
    s.instances.push_back({k % 2,
                           transform::translate(d.in_cube() * 2.0) *
                               transform::rotate(d.direction(), 360 * d.uniform()) * shear *
                               transform::scale({size, size * 0.5, k % 3 == 0 ? -size : size}),
                           instance::own_materials});
  }
  return s;
}

/// Into the scene from around it and from inside: at corners, along edges, with zeros in the
/// direction, cut short, and any.
tracer::ray mixed_ray(const scene& s, std::uint64_t seed, std::uint64_t i) {
  draw d(seed, i);
  const instance& at = s.instances[d.below(std::uint32_t(s.instances.size()))];
  const mesh& m = s.meshes[at.mesh];
  const vec3f o(d.in_cube() * (d.below(4) == 0 ? 1.0 : 3.0));
  if (m.triangle_count() == 0) return make_ray(o, vec3f(d.direction()));
  const std::uint32_t t = d.below(std::uint32_t(m.triangle_count()));
  const int side = int(d.below(3));
  const vec3d a(m.position(t, side)), b(m.position(t, (side + 1) % 3));
  vec3f to;
  switch (d.below(8)) {
    case 0:
    case 1:
      to = vec3f(at.world_from_object.point(a)) - o;
      break;
    case 2:
    case 3:
      to = vec3f(at.world_from_object.point(a + (b - a) * d.uniform())) - o;
      break;
    case 4:
      to = {0, 0, d.below(2) ? 1.0f : -1.0f};
      break;
    case 5:
      to = vec3f(d.direction()), to[int(d.below(3))] = -0.0f;
      break;
    default:
      to = vec3f(d.direction());
  }
  if (to == vec3f()) to.x = 1;
  return make_ray(o, to, 0, d.below(8) == 0 ? 0.7f : INFINITY);
}

/// Those with the same main axis and signs of the direction one after the other, where they are.
std::vector<std::uint64_t> by_octant(const std::vector<tracer::ray>& rays) {
  const auto key = [](const tracer::ray& r) {
    int k = 0, axis = 0;
    for (int i = 0; i < 3; ++i) {
      k = 2 * k + std::signbit(r.direction[i]);
      if (std::abs(r.direction[i]) > std::abs(r.direction[axis])) axis = i;
    }
    return 4 * k + axis;
  };
  std::vector<std::uint64_t> order(rays.size());
  std::iota(order.begin(), order.end(), std::uint64_t(0));
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return key(rays[a]) < key(rays[b]); });
  return order;
}

/// The hits of rays that are traced in that order.
std::vector<tracer::hit> traced_in(const std::vector<std::uint64_t>& order,
                                   tracer::device_scene& on, const std::vector<tracer::ray>& rays) {
  std::vector<tracer::ray> in_order;
  for (const std::uint64_t i : order) in_order.push_back(rays[i]);
  std::vector<tracer::hit> hits(rays.size());
  const std::vector<tracer::hit> found = on.trace(in_order);
  for (std::size_t k = 0; k < order.size(); ++k) hits[order[k]] = found[k];
  return hits;
}

void compare_ways(lab& l, const char* name, const scene& s, std::uint64_t count,
                  bool with_brute_force) {
  const reference::tracer<float> serial(s);
  struct entry {
    std::string name;
    tracer::device_scene on;
    bool in_packets;
    std::vector<std::uint64_t> different{};
  };
  std::vector<entry> all;
  for (const way& w : ways(l, s, with_brute_force))
    all.push_back({std::string(name) + ": " + w.name, l.place(s, w.options), w.in_packets});

  in_batches(l, count, [&](std::uint64_t first, std::uint64_t size) {
    std::vector<tracer::ray> rays(size);
    std::vector<reference::hit<float>> expected(size);
    in_parallel(l, size, [&](std::uint64_t a, std::uint64_t b) {
      for (std::uint64_t i = a; i < b; ++i) {
        rays[i] = mixed_ray(s, l.seed, first + i);
        expected[i] = serial.closest(serial_ray(rays[i]));
      }
    });
    for (entry& e : all) {
      const auto hits = e.in_packets ? traced_in(by_octant(rays), e.on, rays) : e.on.trace(rays);
      for (std::uint64_t i = 0; i < size; ++i)
        if (!same_hit(hits[i], expected[i])) e.different.push_back(first + i);
    }
  });
  for (const entry& e : all) {
    finding f;
    f.what = e.name;
    f.tried = count;
    f.failed = e.different.size();
    std::copy_n(e.different.begin(), std::min(e.different.size(), f.first.size()), f.first.begin());
    l.report(std::move(f));
  }
}

}  // namespace

void duplicates(lab& l) {
  mesh quad;
  add_loose(quad, {-1, -1, 0.25f}, {1, -1, 0.5f}, {1, 1, 0.125f});
  add_loose(quad, {-1, -1, 0.25f}, {1, 1, 0.125f}, {-1, 1, -0.125f});
  const scene single = scene_with(quad);
  const reference::tracer<float> serial(single);
  const auto make = [&](std::uint64_t i) {
    draw d(l.seed, i);
    const vec3f o(d.in_cube() + vec3d(0, 0, 3));
    return make_ray(o, vec3f(d.in_cube()) - o);
  };
  const auto check = [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
    return same_hit(h, serial.closest(serial_ray(r)));
  };
  for (const std::uint64_t k : {2, 10, 1000, 100000}) {
    // Each ray meets all k, so that the work is k times the rays.
    const std::uint64_t count = l.at_most(100000000 / k);
    mesh m;
    for (std::uint64_t c = 0; c < k; ++c)
      for (std::uint32_t t = 0; t < 2; ++t)
        add_loose(m, quad.position(t, 0), quad.position(t, 1), quad.position(t, 2));
    tracer::device_scene on = l.place(scene_with(std::move(m)));
    trace_and_check(l, on, "not the lowest of " + std::to_string(k) + " triangles", count, make,
                    check);
  }
  scene copies = single;
  for (int c = 0; c < 99; ++c) copies.instances.push_back({});
  tracer::device_scene on = l.place(copies);
  trace_and_check(l, on, "not the lowest of 100 instances", l.at_most(100000), make, check);

  // Where triangles lie says nothing of their numbers. Two units above them all distances are the
  // same bits: each is the sum of the edge functions times two, over that sum.
  mesh flat;
  for (std::uint32_t c = 0; c < 300; ++c) {
    draw d(l.seed + 1, c);
    const vec3d at = d.in_cube();
    const auto corner = [&] {
      const vec3f p(at + d.in_cube() * 0.5);
      return vec3f{p.x, p.y, 0.25f};
    };
    const vec3f a = corner(), b = corner();
    add_loose(flat, a, b, corner());
  }
  const scene plane = scene_with(std::move(flat));
  const reference::tracer<float> over_plane(plane);
  tracer::device_scene in_plane = l.place(plane);
  trace_and_check(
      l, in_plane, "not the lowest in a plane", l.at_most(100000),
      [&](std::uint64_t i) {
        draw d(l.seed + 2, i);
        const vec3f o(d.in_cube());
        return make_ray({o.x, o.y, 2.25f}, {0, 0, -1});
      },
      [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
        return same_hit(h, over_plane.closest_brute(serial_ray(r)));
      });
}

void every_way(lab& l) {
  const std::uint64_t share = l.rays / 3;
  compare_ways(l, "loose triangles", scene_with(random_triangles(200, l.seed)), share, true);
  compare_ways(l, "closed mesh", scene_with(noisy_sphere(4)), share, false);
  compare_ways(l, "instances", many_places(l.seed), l.rays - 2 * share, false);
  // Brute force over thousands of triangles, and over instances, for fewer rays.
  compare_ways(l, "instances, brute force", many_places(l.seed), l.at_most(1000), true);
}

void few_triangles(lab& l) {
  for (const std::uint32_t n : {0, 1, 2, 3, 4, 5, 7, 8, 9, 16, 17}) {
    const scene s = scene_with(random_triangles(n, l.seed + n));
    const reference::tracer<float> serial(s);
    for (const bool in_place : {true, false}) {
      scene placed = s;
      if (!in_place)
        placed.instances.push_back({0, transform::translate({8, 0, 0}), instance::own_materials});
      tracer::device_scene on = l.place(placed);
      trace_and_check(
          l, on, std::to_string(n) + (in_place ? " triangles" : " triangles, twice"),
          l.at_most(5000), [&](std::uint64_t i) { return mixed_ray(s, l.seed, i); },
          [&](std::uint64_t, const tracer::ray& r, const tracer::hit& h) {
            if (in_place) return same_hit(h, serial.closest_brute(serial_ray(r)));
            // The second copy stands out of the first one's way, but not of every ray's.
            const auto expected = serial.closest_brute(serial_ray(r));
            return h.instance == 1 ||
                   (h.triangle == expected.triangle && h.instance == expected.instance);
          });
    }
  }
}

}  // namespace facet::study
