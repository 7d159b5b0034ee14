// Boxes, and what trees are built over: triangles by their corners, or boxes.
#ifndef FACET_BOUNDS_H
#define FACET_BOUNDS_H

#include "vec.h"

typedef struct {
  float3 lo, hi;
} Bounds;

static inline Bounds no_bounds(void) {
  Bounds b;
  b.lo = (float3)(INFINITY);
  b.hi = (float3)(-INFINITY);
  return b;
}

// The zero of a bound may have either sign: it reaches no result (device.h).
static inline Bounds joined(Bounds a, Bounds b) {
  Bounds c;
  c.lo = FACET_CULL_MIN(a.lo, b.lo);
  c.hi = FACET_CULL_MAX(a.hi, b.hi);
  return c;
}

// Of a node's child.
static inline Bounds side_bounds(__global const Node* n, uint side) {
  Bounds b;
  b.lo = (float3)(n->x[0][side], n->y[0][side], n->z[0][side]);
  b.hi = (float3)(n->x[1][side], n->y[1][side], n->z[1][side]);
  return b;
}

// Of a finished subtree.
static inline Bounds item_bounds(__global const Item* i) {
  Bounds b;
  b.lo = vec_global(i->lo);
  b.hi = vec_global(i->hi);
  return b;
}

// Half the surface. The order of the operations is part of every tree: builders that work by other
// means get the same bits (cl/serial_sweep.h).
static inline float half_area(Bounds b) {
  const float3 e = b.hi - b.lo;
  return (e.x * e.y + e.y * e.z) + e.z * e.x;
}

// What splitting costs. A sum that is not a number or overflows costs more than all others.
static inline float split_cost(Bounds left, float left_weight, Bounds right, float right_weight) {
  const float cost = half_area(left) * left_weight + half_area(right) * right_weight;
  return cost < INFINITY ? cost : INFINITY;
}

// A subtree of up to LEAF_SURE boxes is a leaf, one of up to LEAF_MOST if testing all of them costs no more
// than visiting its children; each at least 1.
#ifndef LEAF_SURE
#define LEAF_SURE 2u
#endif
#ifndef LEAF_MOST
#define LEAF_MOST 4u
#endif

// What a subtree of `weight` primitives costs a ray that meets it: they are tested LEAF_BLOCK at a time.
#ifndef LEAF_BLOCK
#define LEAF_BLOCK 1u
#endif
static inline float tests_of(float weight) {
  return LEAF_BLOCK == 1u ? weight : ceil(weight * (1.0f / (float)LEAF_BLOCK));
}

// Twice the centre.
static inline float3 centre2(Bounds b) { return b.lo + b.hi; }

// Kernels take PRIMITIVES_ARGUMENT, and hand on PRIMITIVE(i).
#ifdef FACET_ANY_PRIMITIVES
// Triangles or boxes, three or two `rows` each: for kernels by single work-items, which one program has for both.
#define PRIMITIVES_ARGUMENT __global const float4 *restrict primitives, uint rows
#define PRIMITIVE(i) primitives, rows, i
static inline Bounds bounds_at(__global const float4* primitives, uint rows, uint i) {
  const size_t first = rows * (size_t)i;
  const float3 p = primitives[first].xyz, q = primitives[first + 1].xyz, r = primitives[first + rows - 1u].xyz;
  const bool is_box = rows == 2u;
  Bounds b;
  b.lo = is_box ? p : smaller3(smaller3(p, q), r);
  b.hi = is_box ? q : larger3(larger3(p, q), r);
  return b;
}
static inline void fetch_primitive(__global const float4* primitives, uint rows, uint i) {
  // Its rows may lie across two lines.
  fetch_lines(&primitives[rows * (size_t)i], sizeof(float4));
  fetch_lines(&primitives[rows * (size_t)i + rows - 1u], sizeof(float4));
}
#else
#define PRIMITIVES_ARGUMENT PRIMITIVES restrict primitives
#define PRIMITIVE(i) primitives, i
#ifdef FACET_OVER_BOXES
#define PRIMITIVES __global const Box*
static inline Bounds bounds_at(PRIMITIVES boxes, uint i) {
  Bounds b;
  b.lo = vec_global(boxes[i].lo);
  b.hi = vec_global(boxes[i].hi);
  return b;
}
static inline void fetch_primitive(PRIMITIVES boxes, uint i) { fetch_lines(&boxes[i], sizeof(Box)); }
#else
// Three corners in a row.
#define PRIMITIVES __global const float4*
static inline Bounds bounds_at(PRIMITIVES corners, uint i) {
  const float3 p = corners[3 * (size_t)i].xyz, q = corners[3 * (size_t)i + 1].xyz,
               r = corners[3 * (size_t)i + 2].xyz;
  Bounds b;
  b.lo = smaller3(smaller3(p, q), r);
  b.hi = larger3(larger3(p, q), r);
  return b;
}
static inline void fetch_primitive(PRIMITIVES corners, uint i) {
  // Three corners may lie across two lines.
  fetch_lines(&corners[3 * (size_t)i], sizeof(float4));
  fetch_lines(&corners[3 * (size_t)i + 2], sizeof(float4));
}
#endif
#endif

// So many primitives ahead a CPU asks for those that it reads from all over a mesh (fetch_primitive).
#define PRIMITIVES_AHEAD 12u

#endif
