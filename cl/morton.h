// A Morton curve that gives its bits to the longest sides.
#ifndef FACET_MORTON_H
#define FACET_MORTON_H

#include "bounds.h"

// An axis has at most as many bits as a float's significand.
#define MOST_AXIS_BITS 24u

// Gives each bit, from the highest on, to the side of the cells that is then the longest.
static inline void make_curve(float3 lo, float3 hi, __global Curve* curve) {
  float side[3] = {hi.x - lo.x, hi.y - lo.y, hi.z - lo.z};
  const float extent[3] = {side[0], side[1], side[2]};
  uint mask[3] = {0u, 0u, 0u}, bits[3] = {0u, 0u, 0u};
  for (uint bit = 32u; bit-- > 0u;) {
    uint axis = side[1] > side[0] ? 1u : 0u;
    if (side[2] > side[axis]) axis = 2u;
    if (!(side[axis] > 0.0f)) break;
    mask[axis] |= 1u << bit;
    side[axis] = ++bits[axis] < MOST_AXIS_BITS ? side[axis] * 0.5f : 0.0f;
  }
  curve->lo[0] = lo.x, curve->lo[1] = lo.y, curve->lo[2] = lo.z;
  curve->hi[0] = hi.x, curve->hi[1] = hi.y, curve->hi[2] = hi.z;
  for (uint axis = 0u; axis < 3u; ++axis) {
    curve->mask[axis] = mask[axis];
    curve->scale[axis] = bits[axis] == 0u ? 0.0f : (float)(1u << bits[axis]) / extent[axis];
  }
}

static inline uint cell_of(float centre, float lo, float scale, uint mask) {
  const uint cells = 1u << popcount(mask);
  // Comparisons first: a centre that is not finite has a cell, too.
  return (uint)smaller(larger((centre - lo) * scale, 0.0f), (float)(cells - 1u));
}

// The code of a doubled centre.
static inline uint code_along(__global const Curve* curve, float3 c) {
  return deposit(cell_of(c.x, curve->lo[0], curve->scale[0], curve->mask[0]), curve->mask[0]) |
         deposit(cell_of(c.y, curve->lo[1], curve->scale[1], curve->mask[1]), curve->mask[1]) |
         deposit(cell_of(c.z, curve->lo[2], curve->scale[2], curve->mask[2]), curve->mask[2]);
}

#endif
