// How many pairs of a ray and a triangle are tested at once: one, or in the wide layout eight, a lane of a
// vector each: one ray with eight triangles, or eight rays with one. The test is one text for all
// (triangle.h): Real is a number of each pair, Mask what a comparison says of each, to be joined by &, | and !.
#ifndef FACET_LANES_H
#define FACET_LANES_H

#include "features.h"
#include "vec.h"

#ifdef FACET_WIDE
#define FACET_LANES FACET_BLOCK
typedef float8 Real;
typedef int8 Mask;
#else
#define FACET_LANES 1u
typedef float Real;
typedef int Mask;
#endif

// A point of each.
typedef struct {
  Real x, y, z;
} Points;

static inline Real larger_each(Real a, Real bound) { return FACET_CULL_MAX(a, bound); }
static inline Real smaller_each(Real a, Real bound) { return FACET_CULL_MIN(a, bound); }

static inline Points smaller_points(Points a, Points bound) {
  Points p;
  p.x = smaller_each(a.x, bound.x);
  p.y = smaller_each(a.y, bound.y);
  p.z = smaller_each(a.z, bound.z);
  return p;
}

static inline Points larger_points(Points a, Points bound) {
  Points p;
  p.x = larger_each(a.x, bound.x);
  p.y = larger_each(a.y, bound.y);
  p.z = larger_each(a.z, bound.z);
  return p;
}

// `a` where that holds, `b` elsewhere.
static inline Points chosen_points(Mask where, Points a, Points b) {
  Points p;
  p.x = where ? a.x : b.x;
  p.y = where ? a.y : b.y;
  p.z = where ? a.z : b.z;
  return p;
}

static inline Points scaled_points(Real by, Points a) {
  Points p;
  p.x = by * a.x;
  p.y = by * a.y;
  p.z = by * a.z;
  return p;
}

// An interval of each.
typedef struct {
  Real near, far;
} Intervals;

// The main axis changes places with z.
static inline Points swapped_points(uint axis, Points a) {
  Points p;
  p.x = axis == 0u ? a.z : a.x;
  p.y = axis == 1u ? a.z : a.y;
  p.z = axis == 0u ? a.x : axis == 1u ? a.y : a.z;
  return p;
}

#ifdef FACET_WIDE
static inline uint lanes_where(Mask m) { return lanes_of(m); }
static inline Mask in_mask(bool b) { return (Mask)(b ? -1 : 0); }
static inline Real in_all(float x) { return (Real)(x); }
static inline float in_lane(Real x, uint lane) {
  float all[FACET_LANES];
  vstore8(x, 0, all);
  return all[lane];
}
static inline bool is_in(Mask m, uint lane) { return lanes_of(m) >> lane & 1u; }
static inline bool is_all(Mask m) { return lanes_of(m) == (1u << FACET_LANES) - 1u; }

static inline float least_of(Real a) {
  const float4 b = FACET_CULL_MIN(a.lo, a.hi);
  const float2 c = FACET_CULL_MIN(b.lo, b.hi);
  return cull_min1(c.x, c.y);
}
static inline float most_of(Real a) {
  const float4 b = FACET_CULL_MAX(a.lo, a.hi);
  const float2 c = FACET_CULL_MAX(b.lo, b.hi);
  return cull_max1(c.x, c.y);
}

// A lane of what lies in memory.
static inline float stored_lane(const Real* x, uint lane) { return ((const float*)x)[lane]; }
static inline float3 point_in_lane(const Points* p, uint lane) {
  return (float3)(stored_lane(&p->x, lane), stored_lane(&p->y, lane), stored_lane(&p->z, lane));
}
#else
static inline uint lanes_where(Mask m) { return m ? 1u : 0u; }
static inline Mask in_mask(bool b) { return b; }
static inline Real in_all(float x) { return x; }
static inline float in_lane(Real x, uint lane) { return x; }
static inline bool is_in(Mask m, uint lane) { return m; }
#endif

static inline Points point_in_all(float3 a) {
  Points p;
  p.x = in_all(a.x);
  p.y = in_all(a.y);
  p.z = in_all(a.z);
  return p;
}

// Affine maps of each, in the order of vec.h's.
static inline Real map_axis(__global const float* row, Points p) {
  return (row[0] * p.x + row[1] * p.y) + row[2] * p.z;
}
static inline Points map_vectors(__global const float* m, Points v) {
  Points p;
  p.x = map_axis(m, v);
  p.y = map_axis(m + 4, v);
  p.z = map_axis(m + 8, v);
  return p;
}
static inline Points map_points(__global const float* m, Points v) {
  Points p = map_vectors(m, v);
  p.x = p.x + m[3];
  p.y = p.y + m[7];
  p.z = p.z + m[11];
  return p;
}

static inline bool is_none(Mask m) { return lanes_where(m) == 0u; }

// Whether |x| < 2^-63: in vectors by the two highest bits of the exponent, which is one instruction for two.
static inline Mask is_tiny(Real x) {
#ifdef FACET_WIDE
  return (as_int8(x) & 0x60000000) == 0;
#else
  return fabs(x) < 0x1p-63f;
#endif
}

#endif
