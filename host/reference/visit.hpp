// geometry::visit: from the world through the instances to the triangles.
#pragma once

#include <algorithm>

#include "reference/geometry.hpp"
#include "reference/walk.hpp"

namespace facet::reference {

/// Bit k is set unless triangle k of the block certainly is beside the ray: the edge functions of
/// triangle_test four at a time, without its fmas, which four lanes have not. With X the largest of
/// |x| and |y|, and E above all |coordinates| relative to the ray: x and y are off by 2u (E + X), X
/// is at most 2E, and so an edge function by 4X times that, and by 4u X^2 for its own rounding: by
/// less than 48u E X, which is twice the pad times X.
template <class T>
[[gnu::always_inline]] inline unsigned beside_filter(const space<T>& s, const triangle_block& b) {
  lanes<T> x[3], y[3];
  for (std::size_t c = 0; c < 3; ++c) {
    lanes<T> z;
    load(x[c], b.corner[c][std::size_t(s.kx)]);
    load(y[c], b.corner[c][std::size_t(s.ky)]);
    load(z, b.corner[c][std::size_t(s.kz)]);
    z = z - s.origin[s.kz];
    x[c] = (x[c] - s.origin[s.kx]) - s.Sx * z;
    y[c] = (y[c] - s.origin[s.ky]) - s.Sy * z;
  }
  lanes<T> most{};
  for (const auto* from : {x, y})
    for (std::size_t c = 0; c < 3; ++c) {
      const lanes<T> size = from[c] < 0 ? -from[c] : from[c];
      most = size > most ? size : most;
    }
  const lanes<T> off = 2 * s.pad * most;
  const lanes<T> u = x[2] * y[1] - y[2] * x[1];
  const lanes<T> v = x[0] * y[2] - y[0] * x[2];
  const lanes<T> w = x[1] * y[0] - y[1] * x[0];
  return bits_of(((u >= -off) & (v >= -off) & (w >= -off)) |
                 ((u <= off) & (v <= off) & (w <= off)));
}

template <class T>
template <class Visit>
bool geometry<T>::visit(const ray<T>& r, const T& limit, road by, Visit&& v) const {
  if (is_refused(r)) return false;
  const T tmin = r.tmin > 0 ? r.tmin : 0;
  const space<T> world(r.origin, r.direction, extent_);
  const loose_slabs<T> world_slabs(world);

  const auto enter = [&](std::uint32_t instance) {
    const placement<T>& p = placements_[instance];
    const std::uint32_t mesh_id = scene_.instances[instance].mesh;
    const mesh_tree& m = meshes_[mesh_id];
    space<T> moved;
    if (!p.is_plain) {
      const vec3<T> o = p.object_from_world.point(r.origin);
      const vec3<T> d = p.object_from_world.vector(r.direction);
      if (is_refused(o, d)) return false;
      moved = space<T>(o, d, vec3<T>(m.extent));
    }
    const space<T>& object = p.is_plain ? world : moved;
    if (by == road::brute_force) {
      for (std::uint32_t i = 0; i < scene_.meshes[mesh_id].triangle_count(); ++i) {
        if (m.is_shut[i]) continue;
        const candidate<T> c{world, object, p, instance, i, corners_of(instance, i)};
        if (v(c)) return true;
      }
      return false;
    }
    // Out of line, so that the walk keeps its registers: few blocks have a candidate.
    const auto decide = [&](const triangle_block& b, unsigned mask) __attribute__((noinline)) {
      for (; mask != 0; mask &= mask - 1) {
        const auto k = std::size_t(std::countr_zero(mask));
        candidate<T> c{world, object, p, instance, b.triangle[k], {}};
        for (std::size_t i = 0; i < 3; ++i)
          c.corner[i] = {T(b.corner[i][0][k]), T(b.corner[i][1][k]), T(b.corner[i][2][k])};
        if (v(c)) return true;
      }
      return false;
    };
    const auto leaf = [&](std::uint32_t block) {
      const triangle_block& b = m.blocks[block];
      const unsigned mask = beside_filter(object, b);
      return mask != 0 && decide(b, mask);
    };
    if (by == road::scan) {
      for (std::uint32_t block = 0; block < m.blocks.size(); ++block)
        if (leaf(block)) return true;
      return false;
    }
    return walk(m.tree, p.is_plain ? world_slabs : loose_slabs<T>(object), tmin, limit, leaf);
  };

  if (by != road::tree) {
    const auto meets = [&](const box3<T>& box) {
      const interval<T> way = world.slab(box);
      return way.near <= way.far;
    };
    for (std::uint32_t i = 0; i < placements_.size(); ++i) {
      const box3<T>& box = placements_[i].world_box;
      if (box.empty() || (by == road::scan && !meets(box))) continue;
      if (enter(i)) return true;
    }
    return false;
  }
  return walk(tree_, world_slabs, tmin, limit,
              [&](std::uint32_t leaf) { return enter(tree_.order[leaf]); });
}

}  // namespace facet::reference
