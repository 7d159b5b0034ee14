// How many triangles are tested at once: one, or in the wide layout eight, a lane of a vector each. The
// test is one text for both (triangle.h): Real is a number of each triangle, Mask what a comparison
// says of each, to be joined by &, | and !.
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

// A point of each triangle.
typedef struct {
  Real x, y, z;
} Points;

static inline Real larger_each(Real a, Real bound) { return FACET_CULL_MAX(a, bound); }
static inline Real smaller_each(Real a, Real bound) { return FACET_CULL_MIN(a, bound); }

static inline Points smallest_of(Points a, Points b, Points c) {
  Points p;
  p.x = smaller_each(smaller_each(a.x, b.x), c.x);
  p.y = smaller_each(smaller_each(a.y, b.y), c.y);
  p.z = smaller_each(smaller_each(a.z, b.z), c.z);
  return p;
}

static inline Points largest_of(Points a, Points b, Points c) {
  Points p;
  p.x = larger_each(larger_each(a.x, b.x), c.x);
  p.y = larger_each(larger_each(a.y, b.y), c.y);
  p.z = larger_each(larger_each(a.z, b.z), c.z);
  return p;
}

#ifdef FACET_WIDE
static inline uint lanes_where(Mask m) { return lanes_of(m); }
static inline Real in_all(float x) { return (Real)(x); }
static inline float in_lane(Real x, uint lane) {
  float all[FACET_LANES];
  vstore8(x, 0, all);
  return all[lane];
}
static inline bool is_in(Mask m, uint lane) { return lanes_of(m) >> lane & 1u; }
#else
static inline uint lanes_where(Mask m) { return m ? 1u : 0u; }
static inline Real in_all(float x) { return x; }
static inline float in_lane(Real x, uint lane) { return x; }
static inline bool is_in(Mask m, uint lane) { return m; }
#endif

static inline bool is_none(Mask m) { return lanes_where(m) == 0u; }

#endif
