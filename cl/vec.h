// Vectors, with the order of every sum fixed and no product contracted into an fma: the host's
// reference (host/scene/vec.hpp) evaluates the same expressions and gets the same bits.
#ifndef FACET_VEC_H
#define FACET_VEC_H

#pragma OPENCL FP_CONTRACT OFF

#include "device.h"
#include "layout.h"

#define FACET_ULP 5.9604644775390625e-8f  // 2^-24: the unit roundoff of float

static inline float3 vec_global(__global const float* a) { return (float3)(a[0], a[1], a[2]); }

static inline float dot3(float3 a, float3 b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

static inline float3 cross3(float3 a, float3 b) {
  return (float3)(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float length3(float3 a) { return sqrt(dot3(a, a)); }

// A division by the length, not a product with its reciprocal: each component is rounded once.
static inline float3 normalize3(float3 a) { return a / length3(a); }

// The larger and the smaller, where a NaN in `a` counts as no bound at all.
static inline float larger(float a, float bound) { return a > bound ? a : bound; }
static inline float smaller(float a, float bound) { return a < bound ? a : bound; }

static inline float3 larger3(float3 a, float3 b) {
  return (float3)(larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z));
}
static inline float3 smaller3(float3 a, float3 b) {
  return (float3)(smaller(a.x, b.x), smaller(a.y, b.y), smaller(a.z, b.z));
}

// The main axis changes places with z, which takes fewer choices than moving all three in a circle.
static inline float3 swapped(uint axis, float3 a) {
  return (float3)(axis == 0u ? a.z : a.x, axis == 1u ? a.z : a.y,
                  axis == 0u ? a.x : axis == 1u ? a.y : a.z);
}

static inline bool is_black(float3 c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }

// Affine maps, m being three rows of four.
static inline float3 map_point(__global const float* m, float3 p) {
  return (float3)(((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3],
                  ((m[4] * p.x + m[5] * p.y) + m[6] * p.z) + m[7],
                  ((m[8] * p.x + m[9] * p.y) + m[10] * p.z) + m[11]);
}
static inline float3 map_vector(__global const float* m, float3 v) {
  return (float3)((m[0] * v.x + m[1] * v.y) + m[2] * v.z, (m[4] * v.x + m[5] * v.y) + m[6] * v.z,
                  (m[8] * v.x + m[9] * v.y) + m[10] * v.z);
}
// The transposed linear part: of the inverse map, it carries normals.
static inline float3 map_normal(__global const float* m, float3 n) {
  return (float3)((m[0] * n.x + m[4] * n.y) + m[8] * n.z, (m[1] * n.x + m[5] * n.y) + m[9] * n.z,
                  (m[2] * n.x + m[6] * n.y) + m[10] * n.z);
}

#endif
