// Where primitives' centres stand on a Morton curve that gives its bits to the longest sides.
#include "morton.h"

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
__kernel void partial_bounds(PRIMITIVES_ARGUMENT, __global Box* partial, uint count, uint share,
                             __local float* pool) {
  Bounds b = no_bounds();
  const uint begin = (uint)get_group_id(0) * share, end = min(begin + share, count);
  for (uint i = begin + (uint)get_local_id(0); i < end; i += (uint)get_local_size(0)) {
    const float3 c = centre2(bounds_at(PRIMITIVE(i)));
    b.lo = smaller3(c, b.lo);
    b.hi = larger3(c, b.hi);
  }
  reduce_bounds(b, pool);
  if (get_local_id(0) == 0u) write_bounds(pool, &partial[get_group_id(0)]);
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

__kernel void morton_codes(PRIMITIVES_ARGUMENT, __global const Curve* curve, __global uint* codes, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  codes[i] = code_along(curve, centre2(bounds_at(PRIMITIVE(i))));
}
