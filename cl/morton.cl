// Where primitives' centres stand on a Morton curve that gives its bits to the longest sides.
#include "bounds.h"

// The bounds of what all work-items of the group give, at pool[0 .. 5]: a power of two of them.
static inline void reduce_bounds(Bounds b, __local float* pool) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0);
  pool[lid] = b.lo.x, pool[size + lid] = b.lo.y, pool[2u * size + lid] = b.lo.z;
  pool[3u * size + lid] = b.hi.x, pool[4u * size + lid] = b.hi.y, pool[5u * size + lid] = b.hi.z;
  for (uint step = size / 2u; step > 0u; step /= 2u) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lid < step) {
      for (uint k = 0u; k < 3u; ++k) {
        pool[k * size + lid] = smaller(pool[k * size + lid], pool[k * size + lid + step]);
        pool[(k + 3u) * size + lid] = larger(pool[(k + 3u) * size + lid], pool[(k + 3u) * size + lid + step]);
      }
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void write_bounds(__local const float* pool, __global Box* to) {
  const uint size = (uint)get_local_size(0);
  for (uint k = 0u; k < 3u; ++k) {
    to->lo[k] = pool[k * size];
    to->hi[k] = pool[(k + 3u) * size];
  }
}

// Bounds of all doubled centres: first of each group's share, so many in a row, ...
__kernel void partial_bounds(PRIMITIVES restrict primitives, __global Box* partial, uint count, uint share,
                             __local float* pool) {
  Bounds b = no_bounds();
  const uint begin = (uint)get_group_id(0) * share, end = min(begin + share, count);
  for (uint i = begin + (uint)get_local_id(0); i < end; i += (uint)get_local_size(0)) {
    const float3 c = centre2(bounds_at(primitives, i));
    b.lo = smaller3(c, b.lo);
    b.hi = larger3(c, b.hi);
  }
  reduce_bounds(b, pool);
  if (get_local_id(0) == 0u) write_bounds(pool, &partial[get_group_id(0)]);
}

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

// ... then one group of all; and the curve over them.
__kernel void total_bounds(__global const Box* partial, __global Curve* curve, uint count,
                           __local float* pool) {
  Bounds b = no_bounds();
  for (uint i = (uint)get_local_id(0); i < count; i += (uint)get_local_size(0)) {
    b.lo = smaller3(vec_global(partial[i].lo), b.lo);
    b.hi = larger3(vec_global(partial[i].hi), b.hi);
  }
  reduce_bounds(b, pool);
  if (get_local_id(0) == 0u) {
    const uint size = (uint)get_local_size(0);
    make_curve((float3)(pool[0], pool[size], pool[2u * size]),
               (float3)(pool[3u * size], pool[4u * size], pool[5u * size]), curve);
  }
}

static inline uint cell_of(float centre, float lo, float scale, uint mask) {
  const uint cells = 1u << popcount(mask);
  // Comparisons first: a centre that is not finite has a cell, too.
  return (uint)smaller(larger((centre - lo) * scale, 0.0f), (float)(cells - 1u));
}

__kernel void morton_codes(PRIMITIVES restrict primitives, __global const Curve* curve, __global uint* codes, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const float3 c = centre2(bounds_at(primitives, i));
  codes[i] = deposit(cell_of(c.x, curve->lo[0], curve->scale[0], curve->mask[0]), curve->mask[0]) |
             deposit(cell_of(c.y, curve->lo[1], curve->scale[1], curve->mask[1]), curve->mask[1]) |
             deposit(cell_of(c.z, curve->lo[2], curve->scale[2], curve->mask[2]), curve->mask[2]);
}
