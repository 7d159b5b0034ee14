// Boxes in the form that suits a single work-item of a CPU.
#ifndef FACET_PACKED_H
#define FACET_PACKED_H

#include "bounds.h"

// A box that one comparison joins: lo, then -hi; the fourth of each is 0.
typedef float8 Packed;
static inline Packed packed(Bounds b) { return (Packed)(b.lo, 0.0f, -b.hi, 0.0f); }
static inline Packed no_packed(void) { return (Packed)(INFINITY); }
static inline Packed joined_packed(Packed a, Packed b) { return a < b ? a : b; }
static inline float packed_area(Packed b) {
  const float4 e = -b.hi - b.lo;
  return (e.x * e.y + e.y * e.z) + e.z * e.x;
}
static inline float packed_cost(Packed left, float left_weight, Packed right, float right_weight) {
  const float cost = packed_area(left) * left_weight + packed_area(right) * right_weight;
  return cost < INFINITY ? cost : INFINITY;
}

static inline void put_packed(Node* n, uint side, Packed b) {
  n->x[0][side] = b.s0, n->y[0][side] = b.s1, n->z[0][side] = b.s2;
  n->x[1][side] = -b.s4, n->y[1][side] = -b.s5, n->z[1][side] = -b.s6;
}

#endif
