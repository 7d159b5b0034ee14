// A ray in one space, the world or an instance's, with all that the tests of boxes and triangles need of it:
// of one ray, and of the rays of all lanes.
#ifndef FACET_SPACE_H
#define FACET_SPACE_H

#include "box.h"
#include "geometry.h"

typedef struct {
  float3 o;         // in units of 2^e
  Slabs slabs;
  uint axis;        // of the largest |d_i|
  bool is_turned;   // what turns counter-clockwise as seen by the ray turns clockwise once sheared
  float2 shear;     // d_x / d_z, d_y / d_z of the swapped direction
  float unit;       // 2^-e, e being the exponent of E (box.h): corners as seen from o stay below 2
  float t_of_unit;  // 2^e / d_z: what a z of 1 is in t
} Space;

// The axis of the direction's largest component, the first of several.
static inline uint main_axis(float3 d) {
  const float3 a = fabs(d);
  return a.y > a.x ? (a.z > a.y ? 2u : 1u) : (a.z > a.x ? 2u : 0u);
}

// False if the direction cannot be used: not finite, 0, or its largest component outside
// 2^-60 to 2^60; or an origin beyond 2^60. Such a ray meets nothing.
static inline bool space_of(Space* s, float3 o, float3 d, float3 reach) {
  const float3 a = fabs(d);
  s->axis = main_axis(d);
  const float largest = larger(a.x, larger(a.y, a.z));
  const float3 p = fabs(o);
  // The negated comparison refuses a NaN in any component.
  if (!(a.x <= 1.152921504606847e18f && a.y <= 1.152921504606847e18f &&
        a.z <= 1.152921504606847e18f && largest >= 8.673617379884035e-19f &&
        p.x <= 1.152921504606847e18f && p.y <= 1.152921504606847e18f &&
        p.z <= 1.152921504606847e18f))
    return false;
  const float3 main = swapped(s->axis, d);
  s->is_turned = (main.z < 0.0f) != (s->axis != 2u);
  s->shear = main.xy / main.z;
  const float3 e = fabs(o) + reach;
  const float extent = larger(e.x, larger(e.y, e.z));
  const uint exponent = as_uint(larger(extent, 0x1p-60f)) & 0x7f800000u;
  s->unit = as_float(0x7f000000u - exponent);
  s->o = s->unit * o;
  s->slabs = slabs_of(o, d, extent, largest);
  // The largest component is never raised: this is 1 / d_z.
  s->t_of_unit = swapped(s->axis, s->slabs.inverse).z * as_float(exponent);
  return true;
}

// The rays of the lanes: one in all of them, or in the wide layout one in each. They have one main axis, but where it
// is said that others have another.
typedef struct {
  Points o;  // in units of 2^e, the main axis in z's place
  Real shear_x, shear_y, unit, t_of_unit;
  Points inverse, near_offset, far_offset;  // slabs, each axis in its own place
  uint axis;
  Order order;  // of corners as seen along that axis
  Mask is_turned;
} Rays;

static inline Rays in_all_lanes(const Space* s) {
  Rays r;
  r.o = point_in_all(swapped(s->axis, s->o));
  r.shear_x = in_all(s->shear.x);
  r.shear_y = in_all(s->shear.y);
  r.unit = in_all(s->unit);
  r.t_of_unit = in_all(s->t_of_unit);
  r.inverse = point_in_all(s->slabs.inverse);
  r.near_offset = point_in_all(s->slabs.near_offset);
  r.far_offset = point_in_all(s->slabs.far_offset);
  r.axis = s->axis;
  r.order = order_of(s->axis);
  r.is_turned = in_mask(s->is_turned);
  return r;
}

#ifdef FACET_WIDE

// Given that lane's main axis.
static inline Space space_in_lane(const Rays* r, uint axis, uint lane) {
  Space s;
  s.o = swapped(axis, point_in_lane(&r->o, lane));
  s.slabs.inverse = point_in_lane(&r->inverse, lane);
  s.slabs.near_offset = point_in_lane(&r->near_offset, lane);
  s.slabs.far_offset = point_in_lane(&r->far_offset, lane);
  s.axis = axis;
  s.is_turned = ((const int*)&r->is_turned)[lane];
  s.shear = (float2)(stored_lane(&r->shear_x, lane), stored_lane(&r->shear_y, lane));
  s.unit = stored_lane(&r->unit, lane);
  s.t_of_unit = stored_lane(&r->t_of_unit, lane);
  return s;
}

// As slabs_of (box.h) on one axis, where offsets are known.
static inline void slab_of(Real o, Real d, Real pad, Real least, Real* inverse, Real* near_offset,
                           Real* far_offset) {
  *inverse = 1.0f / (fabs(d) < least ? copysign(least, d) : d);
  const Real p = pad * fabs(*inverse), c = -(o * *inverse);
  *near_offset = c - p;
  *far_offset = c + p;
}

// The same on all axes, for directions whose largest components are `largest`; `extent` is E of each (box.h).
static inline void slabs_in_lanes(Points o, Points d, float3 reach, Real largest, Points* inverse, Points* near_offset,
                                  Points* far_offset, Real* extent) {
  *extent = larger_each(fabs(o.x) + reach.x, larger_each(fabs(o.y) + reach.y, fabs(o.z) + reach.z));
  const Real pad = (24.0f * FACET_ULP) * *extent, least = largest * 8.673617379884035e-19f;
  slab_of(o.x, d.x, pad, least, &inverse->x, &near_offset->x, &far_offset->x);
  slab_of(o.y, d.y, pad, least, &inverse->y, &near_offset->y, &far_offset->y);
  slab_of(o.z, d.z, pad, least, &inverse->z, &near_offset->z, &far_offset->z);
}

// The bits of E's exponent, as space_of has them.
static inline uint8 exponent_of(Real extent) {
  return as_uint8(larger_each(extent, in_all(0x1p-60f))) & 0x7f800000u;
}

// As space_of, a ray in each lane, as if it took them all and knew their offsets, which is for the caller to find
// out. They have that main axis, and on each axis their directions have one sign. `extent` is E of each.
static inline void rays_of(Rays* r, uint axis, Points o, Points d, float3 reach, Real* extent) {
  const Points main = swapped_points(axis, d);
  r->axis = axis;
  r->order = order_of(axis);
  r->is_turned = in_mask((main.z.s0 < 0.0f) != (axis != 2u));
  r->shear_x = main.x / main.z;
  r->shear_y = main.y / main.z;
  slabs_in_lanes(o, d, reach, fabs(main.z), &r->inverse, &r->near_offset, &r->far_offset, extent);
  const uint8 exponent = exponent_of(*extent);
  r->unit = as_float8(0x7f000000u - exponent);
  r->o = scaled_points(r->unit, swapped_points(axis, o));
  r->t_of_unit = swapped_points(axis, r->inverse).z * as_float8(exponent);
}

// Takes for those lanes the same rays as seen along another axis. Slabs are alike.
static inline void see_along(Rays* r, Mask others, const Rays* seen) {
  r->o = chosen_points(others, seen->o, r->o);
  r->shear_x = others ? seen->shear_x : r->shear_x;
  r->shear_y = others ? seen->shear_y : r->shear_y;
  r->t_of_unit = others ? seen->t_of_unit : r->t_of_unit;
  r->is_turned = others ? seen->is_turned : r->is_turned;
}

#endif

#endif
