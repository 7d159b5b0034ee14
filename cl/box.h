// Slab intervals of boxes along a ray, padded so that no rounding can lose a hit.
//
// The interval of a box is [max_i fma(near_i, inv_i, near_offset_i), min_i fma(far_i, inv_i,
// far_offset_i)]; a triangle's t lies in the interval of the triangle's own box, or is held to
// it (triangle.h). Every operation is monotone in the box's faces and the offsets are the ray's
// alone: the interval of a node holds those of all boxes inside it, bit for bit, in whichever tree
// it stands. A node may therefore be left out when its near end is beyond the best t (but not at
// equality), when its far end is before tmin, or when it is empty, and no tree can change the hit.
//
// What this takes, and the test that holds it (tests/tracer/query_test.cpp, facet accuracy):
//   -, *, fma and comparisons are correctly rounded, nothing is contracted     elementary, case 11
//   a node's box holds its triangles' exactly                                  tree, case 12
//   t is in its triangle's interval: the same bits where it is always held     case 11
//   nodes are left out beyond the best t alone, and ties go to the smaller id  cases 10, 11
//
// The pad of 24 u E, with E the largest |origin| + |face| of any axis and u = 2^-24, covers the
// rounding here (inv, o * inv, both offsets, the fma: 4u|o| + 2u|face|), that of the triangle test
// (18u E) and the change of directions that are nearly 0 below. It is absolute in space: a relative
// one loses hits on edges that lie in a box's face while their ends are far from the ray.
#ifndef FACET_BOX_H
#define FACET_BOX_H

#include "features.h"
#include "vec.h"

// A number of each of a node's children, two or in the wide layout eight.
#ifdef FACET_WIDE
typedef float8 Each;
#else
typedef float2 Each;
#endif

typedef struct {
  float3 inverse;
  float3 near_offset, far_offset;
} Slabs;

typedef struct {
  float near, far;
} Interval;

// extent: E, of the space's whole box. largest: max |d_i|, not 0.
// A component below largest * 2^-60 is raised to it: no infinity arises, and the pad covers the
// change, as t * |d_i| differs by less than 2^-60 E.
static inline Slabs slabs_of(float3 o, float3 d, float extent, float largest) {
  const float pad = (24.0f * FACET_ULP) * extent;
  const float least = largest * 8.673617379884035e-19f;
  const float3 raised = fabs(d) < least ? copysign((float3)(least), d) : d;
  Slabs s;
  s.inverse = 1.0f / raised;
  const float3 p = pad * fabs(s.inverse);
  const float3 c = -(o * s.inverse);
  // An axis whose offset overflows tells nothing of where the ray is.
  const int3 is_known = fabs(c) < INFINITY;
  s.near_offset = is_known ? c - p : (float3)(-INFINITY);
  s.far_offset = is_known ? c + p : (float3)(INFINITY);
  return s;
}

static inline Interval box_interval(const Slabs s, float3 lo, float3 hi) {
  const float3 near = fma(s.inverse > 0.0f ? lo : hi, s.inverse, s.near_offset);
  const float3 far = fma(s.inverse > 0.0f ? hi : lo, s.inverse, s.far_offset);
  Interval i;
  i.near = cull_max1(near.z, cull_max1(near.y, cull_max1(near.x, -INFINITY)));
  i.far = cull_min1(far.z, cull_min1(far.y, cull_min1(far.x, INFINITY)));
  return i;
}

// Which side of a node's children the ray meets first, of each axis: the floats to skip, 0 or FACET_SIDE.
#define FACET_SIDE ((uint)(sizeof(Each) / sizeof(float)))
typedef struct {
  uint x, y, z;
} Sides;

static inline Sides near_sides(const Slabs s) {
  Sides n;
  n.x = s.inverse.x > 0.0f ? 0u : FACET_SIDE;
  n.y = s.inverse.y > 0.0f ? 0u : FACET_SIDE;
  n.z = s.inverse.z > 0.0f ? 0u : FACET_SIDE;
  return n;
}

// The two sides of an axis, the one met first first. A GPU's time goes by loads more than by bytes: two
// children's sides are one, and then chosen from.
static inline void read_sides(__global const float* axis, uint near_at, Each* near, Each* far) {
#ifdef FACET_WIDE
  *near = *(__global const Each*)(axis + near_at);
  *far = *(__global const Each*)(axis + (FACET_SIDE - near_at));
#else
  const float4 both = *(__global const float4*)axis;
  *near = near_at == 0u ? both.lo : both.hi;
  *far = near_at == 0u ? both.hi : both.lo;
#endif
}

static inline Each crossed_at(Each face, float inverse, float offset) {
  return fma(face, (Each)(inverse), (Each)(offset));
}

// What three axes have in common, from tmin to best.
static inline void common_interval(Each nx, Each ny, Each nz, Each fx, Each fy, Each fz, float tmin, float best,
                                   Each* near, Each* far) {
  const Each x = FACET_CULL_MAX(nx, (Each)(tmin)), a = FACET_CULL_MIN(fx, (Each)(best));
  const Each y = FACET_CULL_MAX(ny, x), b = FACET_CULL_MIN(fy, a);
  *near = FACET_CULL_MAX(nz, y);
  *far = FACET_CULL_MIN(fz, b);
}

// The intervals of a node's children, cut to tmin and best: child c must be visited exactly
// where near c <= far c. `faces` are the node's six sides in order.
static inline void child_intervals(const Slabs s, const Sides near_at, __global const float* faces,
                                   float tmin, float best, Each* near, Each* far) {
  Each nx, fx, ny, fy, nz, fz;
  read_sides(faces, near_at.x, &nx, &fx);
  read_sides(faces + 2u * FACET_SIDE, near_at.y, &ny, &fy);
  read_sides(faces + 4u * FACET_SIDE, near_at.z, &nz, &fz);
  nx = crossed_at(nx, s.inverse.x, s.near_offset.x), fx = crossed_at(fx, s.inverse.x, s.far_offset.x);
  ny = crossed_at(ny, s.inverse.y, s.near_offset.y), fy = crossed_at(fy, s.inverse.y, s.far_offset.y);
  nz = crossed_at(nz, s.inverse.z, s.near_offset.z), fz = crossed_at(fz, s.inverse.z, s.far_offset.z);
  common_interval(nx, ny, nz, fx, fy, fz, tmin, best, near, far);
}

#ifndef FACET_WIDE

// An inverse direction's parts above and below 0. One of them is 0, as is its product with a face.
typedef struct {
  float3 above, below;
} Parts;

static inline Parts parts_of(const Slabs s) {
  Parts p;
  p.above = s.inverse > 0.0f ? s.inverse : (float3)(0.0f);
  p.below = s.inverse > 0.0f ? (float3)(0.0f) : s.inverse;
  return p;
}

static inline void cross_by_parts(__global const float* axis, float above, float below, float near_offset,
                                  float far_offset, Each* near, Each* far) {
  const float4 sides = *(__global const float4*)axis;
  *near = fma(sides.hi, (Each)(below), crossed_at(sides.lo, above, near_offset));
  *far = fma(sides.lo, (Each)(below), crossed_at(sides.hi, above, far_offset));
}

// The same intervals as child_intervals gives. A GPU chooses between sides at half the rate of an fma, and by what
// finds minima and maxima, too, which is as much as that can do.
static inline void child_intervals_by_parts(const Slabs s, const Parts p, __global const float* faces, float tmin,
                                            float best, Each* near, Each* far) {
  Each nx, fx, ny, fy, nz, fz;
  cross_by_parts(faces, p.above.x, p.below.x, s.near_offset.x, s.far_offset.x, &nx, &fx);
  cross_by_parts(faces + 4u, p.above.y, p.below.y, s.near_offset.y, s.far_offset.y, &ny, &fy);
  cross_by_parts(faces + 8u, p.above.z, p.below.z, s.near_offset.z, s.far_offset.z, &nz, &fz);
  common_interval(nx, ny, nz, fx, fy, fz, tmin, best, near, far);
}

#endif

#endif
