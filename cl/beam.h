// What holds all rays of a packet at once: a box or a node that it does not meet is left out for all of them by
// one test.
#ifndef FACET_BEAM_H
#define FACET_BEAM_H

#include "space.h"

// Of one axis: bounds of the terms of all rays' slabs as seen from `centre`, a point among their origins.
typedef struct {
  float centre;
  float least_inverse, most_inverse;
  float near_offset, far_offset;
  uint side;  // that they meet first (box.h: Sides)
} BeamAxis;

typedef struct {
  BeamAxis x, y, z;
  float tmin;  // the least
} Beam;

// Of terms that are each a bound over some of the rays, a lane each; near and far are offsets plus centre *
// inverse. Where a ray crosses a face is, in exact arithmetic, (face - centre) * inverse + (offset + centre *
// inverse): the product lies between those with the least and the most inverse. What floats make of either form
// is off by less than 8 u E |inverse|, E as in box.h, and 16 are allowed for.
static inline BeamAxis beam_axis(float centre, Real least, Real most, Real near, Real far, float extent) {
  BeamAxis a;
  a.centre = centre;
  a.least_inverse = least_of(least);
  a.most_inverse = most_of(most);
  const float slack =
      (16.0f * FACET_ULP) * extent * cull_max1(fabs(a.least_inverse), fabs(a.most_inverse));
  a.near_offset = least_of(near) - slack;
  a.far_offset = most_of(far) + slack;
  a.side = a.least_inverse > 0.0f ? 0u : FACET_SIDE;
  return a;
}

// The least and the largest |inverse|.
static inline float flattest(const BeamAxis* a) {
  return cull_min1(fabs(a->least_inverse), fabs(a->most_inverse));
}
static inline float steepest(const BeamAxis* a) {
  return cull_max1(fabs(a->least_inverse), fabs(a->most_inverse));
}

static inline const BeamAxis* axis_of(const Beam* b, uint axis) {
  return axis == 0u ? &b->x : axis == 1u ? &b->y : &b->z;
}

// Whether space_of takes all rays, and knows their offsets; no where it only just would. The inverse directions are
// asked, whose bounds are known; none of them is NaN.
static inline bool are_rays_usable(const Beam* b, uint axis, float extent) {
  const BeamAxis* main = axis_of(b, axis);
  const float most = cull_max1(steepest(&b->x), cull_max1(steepest(&b->y), steepest(&b->z)));
  return flattest(main) >= 0x1p-50f && steepest(main) <= 0x1p50f && extent <= 0x1p50f && extent * most <= 0x1p100f;
}

// Whether all rays have that main axis.
static inline bool is_main_axis(const Beam* b, uint axis) {
  const BeamAxis *first = axis_of(b, axis == 0u ? 2u : 0u), *second = axis_of(b, axis == 1u ? 2u : 1u);
  return steepest(axis_of(b, axis)) < cull_min1(flattest(first), flattest(second));
}

static inline Each first_crossing(const BeamAxis* a, Each face) {
  const Each f = face - a->centre, offset = (Each)(a->near_offset);
  return FACET_CULL_MIN(fma(f, (Each)(a->least_inverse), offset), fma(f, (Each)(a->most_inverse), offset));
}
static inline Each last_crossing(const BeamAxis* a, Each face) {
  const Each f = face - a->centre, offset = (Each)(a->far_offset);
  return FACET_CULL_MAX(fma(f, (Each)(a->least_inverse), offset), fma(f, (Each)(a->most_inverse), offset));
}

// The intervals of eight boxes for all rays at once, given the sides met first and last: where near > far,
// no ray's own interval (box.h) holds anything.
static inline void beam_intervals(const Beam* b, Each nx, Each fx, Each ny, Each fy, Each nz, Each fz,
                                  float best, Each* near, Each* far) {
  const Each x = FACET_CULL_MAX(first_crossing(&b->x, nx), (Each)(b->tmin));
  const Each y = FACET_CULL_MAX(first_crossing(&b->y, ny), x);
  *near = FACET_CULL_MAX(first_crossing(&b->z, nz), y);
  const Each u = FACET_CULL_MIN(last_crossing(&b->x, fx), (Each)(best));
  const Each v = FACET_CULL_MIN(last_crossing(&b->y, fy), u);
  *far = FACET_CULL_MIN(last_crossing(&b->z, fz), v);
}

#endif
