// What holds all rays of a packet at once: a box or a node that it does not meet is left out for all of them by
// one test.
#ifndef FACET_BEAM_H
#define FACET_BEAM_H

#include "space.h"

// Bounds of the terms of all rays' slabs as seen from `centre`, a point among their origins: of x, y, z and once more z.
typedef struct {
  float centre[4];
  float least_inverse[4], most_inverse[4];
  float near_offset[4], far_offset[4];
  uint side[3];  // that they meet first (box.h: Sides)
  float tmin;    // the least
} Beam;

// Bounds of the lanes of each of eight vectors, which are halved three times; `largest` is a literal.
static inline Each halved(Each a, Each b, bool largest) {
  const Each even = (Each)(a.even, b.even), odd = (Each)(a.odd, b.odd);
  return largest ? larger_each(even, odd) : smaller_each(even, odd);
}
static inline Each bounds_of_lanes(const Each a[8], bool largest) {
  const Each b = halved(a[0], a[1], largest), c = halved(a[2], a[3], largest), d = halved(a[4], a[5], largest),
             e = halved(a[6], a[7], largest);
  return halved(halved(b, c, largest), halved(d, e, largest), largest);
}

// Of three axes: the least and the largest |inverse| there.
static inline float4 flattest(const Beam* b) {
  return FACET_CULL_MIN(fabs(vload4(0, b->least_inverse)), fabs(vload4(0, b->most_inverse)));
}
static inline float4 steepest(const Beam* b) {
  return FACET_CULL_MAX(fabs(vload4(0, b->least_inverse)), fabs(vload4(0, b->most_inverse)));
}

// Of terms that are each a bound over some of the rays, a lane each; near and far are offsets plus centre *
// inverse. Where a ray crosses a face is, in exact arithmetic, (face - centre) * inverse + (offset + centre *
// inverse): the product lies between those with the least and the most inverse. What floats make of either form
// is off by less than 8 u E |inverse|, E as in box.h, and 16 are allowed for.
//
// False if space_of might not take all rays, or not know their offsets, but for directions that are too short.
// Inverse directions are asked, whose bounds are known; none of them is NaN.
static inline bool beam_of_bounds(float3 centre, Points least, Points most, Points near, Points far, Real tmin,
                                  Real extent, Beam* b) {
  const Each low[8] = {least.x, least.y, least.z, tmin, near.x, near.y, near.z, near.z};
  const Each high[8] = {most.x, most.y, most.z, extent, far.x, far.y, far.z, far.z};
  const Each from = bounds_of_lanes(low, false), to = bounds_of_lanes(high, true);
  vstore4(centre.xyzz, 0, b->centre);
  vstore4(from.s0122, 0, b->least_inverse);
  vstore4(to.s0122, 0, b->most_inverse);
  const float4 steep = steepest(b), product = to.s3 * steep, slack = (16.0f * FACET_ULP) * product;
  vstore4(from.hi - slack, 0, b->near_offset);
  vstore4(to.hi + slack, 0, b->far_offset);
  for (int i = 0; i < 3; ++i) b->side[i] = b->least_inverse[i] > 0.0f ? 0u : FACET_SIDE;
  b->tmin = from.s3;
  return is_all((Mask)(flattest(b) >= 0x1p-50f, (product <= 0x1p100f) & (to.s3333 <= 0x1p50f)));
}

// The axes where no ray's |inverse| is more than space_of takes of the main one's.
static inline int4 are_flat(const Beam* b) { return steepest(b) <= 0x1p50f; }

// Whether all rays have the same main axis, with nothing to spare: there all inverses are less than all on the others.
static inline bool have_one_axis(const Beam* b) {
  const float4 flat = flattest(b);
  const int4 is_main = (steepest(b) < FACET_CULL_MIN(flat.yxxx, flat.zzyy)) & are_flat(b);
  return !is_none((Mask)(is_main, is_main));
}

// Where planes across an axis, a lane each, are met first and last.
static inline Each first_crossing(const Beam* b, int axis, Each face) {
  const Each f = face - b->centre[axis], offset = (Each)(b->near_offset[axis]);
  return FACET_CULL_MIN(fma(f, (Each)(b->least_inverse[axis]), offset), fma(f, (Each)(b->most_inverse[axis]), offset));
}
static inline Each last_crossing(const Beam* b, int axis, Each face) {
  const Each f = face - b->centre[axis], offset = (Each)(b->far_offset[axis]);
  return FACET_CULL_MAX(fma(f, (Each)(b->least_inverse[axis]), offset), fma(f, (Each)(b->most_inverse[axis]), offset));
}

// The intervals of eight boxes for all rays at once, given the sides met first and last: where near > far,
// no ray's own interval (box.h) holds anything.
static inline void beam_intervals(const Beam* b, Each nx, Each fx, Each ny, Each fy, Each nz, Each fz,
                                  float best, Each* near, Each* far) {
  const Each x = FACET_CULL_MAX(first_crossing(b, 0, nx), (Each)(b->tmin));
  const Each y = FACET_CULL_MAX(first_crossing(b, 1, ny), x);
  *near = FACET_CULL_MAX(first_crossing(b, 2, nz), y);
  const Each u = FACET_CULL_MIN(last_crossing(b, 0, fx), (Each)(best));
  const Each v = FACET_CULL_MIN(last_crossing(b, 1, fy), u);
  *far = FACET_CULL_MIN(last_crossing(b, 2, fz), v);
}

#endif
