// Rays of a stream: taken up, eight at once, and what single ones of them meet.
#ifndef FACET_STREAM_H
#define FACET_STREAM_H

#include "query.h"
#include "stream_layout.h"
#include "transpose.h"

// As space_of (space.h) of a ray in each lane where `usable`, which is said of rays that space_of takes, whose offsets
// are known, unless the space reaches beyond 2^60.
typedef struct {
  Points inverse, near_offset, far_offset, o;  // o: in units of 2^e, the main axis in z's place
  Real shear_x, shear_y, unit, t_of_unit;
  uint8 order;  // layout: StreamRay
  Mask usable;
} Spaces;

static inline uint8 bytes_of(Order o) { return (uint8)(o.x | o.y << 8 | o.z << 16); }

static inline Spaces spaces_of(Points o, Points d, float3 reach) {
  Spaces s;
  const Real x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
  const Mask over_x = y > x, on_z = z > (over_x ? y : x), on_y = over_x & !on_z, on_x = !over_x & !on_z;
  const Real main = on_z ? d.z : on_y ? d.y : d.x;
  s.o.x = on_x ? o.z : o.x;
  s.o.y = on_y ? o.z : o.y;
  s.o.z = on_z ? o.z : on_y ? o.y : o.x;
  s.shear_x = (on_x ? d.z : d.x) / main;
  s.shear_y = (on_y ? d.z : d.y) / main;
  Real extent;
  slabs_in_lanes(o, d, reach, fabs(main), &s.inverse, &s.near_offset, &s.far_offset, &extent);
  const uint8 exponent = exponent_of(extent);
  s.unit = as_float8(0x7f000000u - exponent);
  s.o = scaled_points(s.unit, s.o);
  s.t_of_unit = (on_z ? s.inverse.z : on_y ? s.inverse.y : s.inverse.x) * as_float8(exponent);
  s.order = on_z ? bytes_of(order_of(2u)) : on_y ? bytes_of(order_of(1u)) : bytes_of(order_of(0u));
  // A sum is NaN or infinite where a term is. No component of o is more than the extent, none of d than the main one.
  const Real offsets = (s.near_offset.x + s.near_offset.y) + s.near_offset.z;
  s.usable = (extent <= 0x1p60f) & (fabs(main) <= 0x1p60f) & (fabs(main) >= 0x1p-60f) & (fabs(offsets) < INFINITY);
  return s;
}

// Takes up those of eight rays in `which` that can be, and have anything to look for; gives the others. `from`: of the
// first. `count` rays are in the stream; there is room.
APART uint add_rays(__global Stream* x, uint* count, Points o, Points d, Real tmin, Real tmax, float3 reach, uint which,
                    uint from) {
  const Spaces s = spaces_of(o, d, reach);
  const uint taken = which & lanes_of(s.usable & (tmin <= tmax));
  const Points c = s.inverse, n = s.near_offset, f = s.far_offset;
  const uint8 lane = (uint8)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u);
  Real ray[8] = {c.x, c.y, c.z, n.x, n.y, n.z, f.x, f.y};
  Real more[8] = {f.z, tmin, tmax, in_all(0.0f), s.o.x, s.o.y, s.o.z, as_float8(s.order)};
  Real rest[8] = {s.shear_x,    s.shear_y,    s.unit,       s.t_of_unit,
                  in_all(0.0f), in_all(0.0f), in_all(0.0f), as_float8(lane + from)};
  transpose(ray);
  transpose(more);
  transpose(rest);
  uint kind[FACET_LANES];
  vstore8(as_uint8(d.x) >> 31 | as_uint8(d.y) >> 31 << 1 | as_uint8(d.z) >> 31 << 2, 0, kind);
  for (uint lanes = taken; lanes != 0u; lanes = without_first(lanes)) {
    const uint i = first_lane(lanes), at = (*count)++;
    __global float *to_ray = (__global float*)&x->ray[at], *to_rest = (__global float*)&x->rest[at];
    vstore8(ray[i], 0, to_ray);
    vstore8(more[i], 1, to_ray);
    x->ray[at].slot = FACET_NONE;
    vstore8(rest[i], 0, to_rest);
    x->kind[at] = kind[i];
  }
  return which & ~taken;
}

static inline Points point_from(__global const float* a) {
  Points p;
  p.x = in_all(a[0]);
  p.y = in_all(a[1]);
  p.z = in_all(a[2]);
  return p;
}

// The ray in all lanes.
static inline Rays rays_in_stream(__global const StreamRay* ray, __global const StreamRest* rest) {
  Rays r;
  r.o = point_from(ray->origin);
  r.shear_x = in_all(rest->shear[0]);
  r.shear_y = in_all(rest->shear[1]);
  r.unit = in_all(rest->unit);
  r.t_of_unit = in_all(rest->t_of_unit);
  r.inverse = point_from(ray->inverse);
  r.near_offset = point_from(ray->near_offset);
  r.far_offset = point_from(ray->far_offset);
  r.order.x = ray->order[0], r.order.y = ray->order[1], r.order.z = ray->order[2];
  return r;
}

// Takes in that the ray meets the triangles of a block in the lanes `left`.
INLINED void take_lanes(const Scene* s, uint block, const TriangleHits* hits, uint left, __global StreamRay* ray,
                        __global StreamRest* rest, uint mode) {
  if (left != 0u && mode == FACET_ANY) {
    ray->t = -INFINITY;
    ray->slot = 0u;
    return;
  }
  for (; left != 0u; left = without_first(left)) {
    const uint lane = first_lane(left), slot = FACET_LANES * block + lane, best = ray->slot;
    const float t = in_lane(hits->t, lane);
    if (t >= ray->t && (t > ray->t || (best != FACET_NONE && !is_before(s, 0u, slot, 0u, best)))) continue;
    ray->t = t;
    ray->slot = slot;
    rest->v = in_lane(hits->v, lane);
    rest->w = in_lane(hits->w, lane);
    rest->det = in_lane(hits->det, lane);
  }
}

// A block's triangles and a ray. Those that are doubtful are left, and added to `doubtful`: the ray is to be traced by
// itself then.
INLINED void meet_block_alone(const Scene* s, GEOMETRY positions, uint block, __global StreamRay* ray,
                              __global StreamRest* rest, uint mode, Mask* doubtful) {
  const Intervals outer = {in_all(-INFINITY), in_all(INFINITY)};
  const Rays r = rays_in_stream(ray, rest);
  TriangleHits hits;
  const Mask met =
      hit_triangles(&r, triangles_from(positions, block), outer, in_all(ray->tmin), in_all(ray->t), false, &hits);
  *doubtful |= hits.is_doubtful;
  const uint left = lanes_of(met);
  if (left != 0u) take_lanes(s, block, &hits, left & ~lanes_of(hits.is_doubtful), ray, rest, mode);
}

#endif
