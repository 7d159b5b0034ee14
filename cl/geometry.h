// Where a triangle's corners are read from: float4 texels of an image2d, to go through the texture
// cache as the source design does, or a buffer. Three in a row belong to one triangle.
#ifndef FACET_GEOMETRY_H
#define FACET_GEOMETRY_H

#include "lanes.h"

#ifdef FACET_GEOMETRY_IMAGE

#define GEOMETRY read_only image2d_t
#define FACET_IMAGE_BITS 13  // an image is 2^13 texels wide, which every full device allows

static inline float3 read_corner(GEOMETRY g, uint index) {
  const int2 at = (int2)((int)(index & ((1u << FACET_IMAGE_BITS) - 1u)), (int)(index >> FACET_IMAGE_BITS));
  return read_imagef(g, at).xyz;
}

#else

#define GEOMETRY __global const float4* restrict

static inline float3 read_corner(GEOMETRY g, uint index) { return g[index].xyz; }

#endif

// Texels 3 * slot to 3 * slot + 2; slots are triangles in leaf order, below 2^27.
static inline void read_texels(GEOMETRY g, uint slot, float3* a, float3* b, float3* c) {
  *a = read_corner(g, 3u * slot);
  *b = read_corner(g, 3u * slot + 1u);
  *c = read_corner(g, 3u * slot + 2u);
}

static inline void read_normals(GEOMETRY g, uint slot, float3* n0, float3* n1, float3* n2) {
  read_texels(g, slot, n0, n1, n2);
}

#ifdef FACET_WIDE

// Where a corner's coordinates lie that stand in x's, y's and z's place, the main axis in z's: floats to skip.
typedef struct {
  uint x, y, z;
} Order;

static inline Order order_of(uint axis) {
  const Order o = {FACET_BLOCK * (axis == 0u ? 2u : 0u), FACET_BLOCK * (axis == 1u ? 2u : 1u), FACET_BLOCK * axis};
  return o;
}

// What is tested at once: a block's triangles (layout.h: TriangleBlock), or one of them in all lanes.
typedef struct {
  __global const float* first;
  bool is_one, is_mixed;  // literals
  Mask others;            // if mixed: lanes that see corners in another order than that of their rays
  Order of_others;
} Triangles;

static inline Triangles triangles_from(GEOMETRY g, uint block) {
  Triangles t;
  t.first = (__global const float*)((__global const TriangleBlock*)g + block);
  t.is_one = t.is_mixed = false;
  return t;
}

// For what is seldom asked, of triangles that may be gone from the registers.
static inline Triangles read_again(GEOMETRY g, Triangles t) { return t; }

static inline Triangles one_triangle(Triangles block, uint lane) {
  Triangles t;
  t.first = block.first + lane;
  t.is_one = true;
  t.is_mixed = false;
  return t;
}

// The same, seen along two main axes.
static inline Triangles mixed_triangle(Triangles block, uint lane, Mask others, uint axis) {
  Triangles t = one_triangle(block, lane);
  t.is_mixed = true;
  t.others = others;
  t.of_others = order_of(axis);
  return t;
}

static inline void read_triangle(GEOMETRY g, uint slot, float3* p0, float3* p1, float3* p2) {
  __global const float* x = triangles_from(g, slot / FACET_BLOCK).first + slot % FACET_BLOCK;
  *p0 = (float3)(x[0], x[8], x[16]);
  *p1 = (float3)(x[24], x[32], x[40]);
  *p2 = (float3)(x[48], x[56], x[64]);
}

// A coordinate of each: `skipped` floats come before it, a row of FACET_BLOCK for each of the nine.
static inline Real coordinate(Triangles t, uint skipped) {
  __global const float* at = t.first + skipped;
  return t.is_one ? (Real)(*at) : *(__global const Real*)at;
}

static inline Points corner_in(Triangles t, int corner, Order order) {
  Points p;
  p.x = coordinate(t, FACET_BLOCK * 3 * corner + order.x);
  p.y = coordinate(t, FACET_BLOCK * 3 * corner + order.y);
  p.z = coordinate(t, FACET_BLOCK * 3 * corner + order.z);
  return p;
}

static inline Points points_of(Triangles t, int corner) { return corner_in(t, corner, order_of(2u)); }

static inline Points swapped_corner(Triangles t, int corner, Order order) {
  const Points p = corner_in(t, corner, order);
  return t.is_mixed ? chosen_points(t.others, corner_in(t, corner, t.of_others), p) : p;
}

#else

typedef struct {
  float3 corner[3];
  uint slot;
} Triangles;

static inline void read_triangle(GEOMETRY g, uint slot, float3* p0, float3* p1, float3* p2) {
  read_texels(g, slot, p0, p1, p2);
}

static inline Triangles triangles_from(GEOMETRY g, uint slot) {
  Triangles t;
  read_triangle(g, slot, &t.corner[0], &t.corner[1], &t.corner[2]);
  t.slot = slot;
  return t;
}

static inline Triangles read_again(GEOMETRY g, Triangles t) { return triangles_from(g, as_another(t.slot)); }

static inline Points points_of(Triangles t, int corner) { return point_in_all(t.corner[corner]); }

// The main axis, which stands in z's place.
typedef uint Order;

static inline Order order_of(uint axis) { return axis; }

static inline Points swapped_corner(Triangles t, int corner, Order order) {
  return point_in_all(swapped(order, t.corner[corner]));
}

#endif

static inline void bounds_of(Triangles t, Points* lo, Points* hi) {
  const Points p0 = points_of(t, 0), p1 = points_of(t, 1), p2 = points_of(t, 2);
  *lo = smaller_points(smaller_points(p0, p1), p2);
  *hi = larger_points(larger_points(p0, p1), p2);
}

#endif
