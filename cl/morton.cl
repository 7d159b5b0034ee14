// Primitives' boxes, their bounds, and where their centres stand on the Morton curve.
#include "vec.h"

// The boxes of triangles, three corners in a row in `positions`.
__kernel void triangle_boxes(__global const float4* positions, __global Box* boxes, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const float3 a = positions[3u * i].xyz, b = positions[3u * i + 1u].xyz, c = positions[3u * i + 2u].xyz;
  const float3 lo = smaller3(smaller3(a, b), c), hi = larger3(larger3(a, b), c);
  Box box;
  box.lo[0] = lo.x, box.lo[1] = lo.y, box.lo[2] = lo.z, box.spare0 = 0u;
  box.hi[0] = hi.x, box.hi[1] = hi.y, box.hi[2] = hi.z, box.spare1 = 0u;
  boxes[i] = box;
}

static inline float3 centre(__global const Box* b) {
  return (vec_global(b->lo) + vec_global(b->hi)) * 0.5f;
}

// Bounds of all centres in two steps, since min and max may be taken in any order: first each
// of the launched work-items those of every get_global_size(0)-th box, ...
__kernel void partial_bounds(__global const Box* boxes, __global Box* partial, uint count) {
  float3 lo = (float3)(INFINITY), hi = (float3)(-INFINITY);
  for (size_t i = get_global_id(0); i < count; i += get_global_size(0)) {
    const float3 c = centre(&boxes[i]);
    lo = smaller3(c, lo);
    hi = larger3(c, hi);
  }
  __global Box* out = &partial[get_global_id(0)];
  out->lo[0] = lo.x, out->lo[1] = lo.y, out->lo[2] = lo.z;
  out->hi[0] = hi.x, out->hi[1] = hi.y, out->hi[2] = hi.z;
}

// ... then one work-item those of the partial ones, into the first.
__kernel void total_bounds(__global Box* partial, uint count) {
  float3 lo = vec_global(partial[0].lo), hi = vec_global(partial[0].hi);
  for (uint i = 1u; i < count; ++i) {
    lo = smaller3(vec_global(partial[i].lo), lo);
    hi = larger3(vec_global(partial[i].hi), hi);
  }
  partial[0].lo[0] = lo.x, partial[0].lo[1] = lo.y, partial[0].lo[2] = lo.z;
  partial[0].hi[0] = hi.x, partial[0].hi[1] = hi.y, partial[0].hi[2] = hi.z;
}

// The low 21 bits of x, two zeros after each.
static inline ulong spread(uint x) {
  ulong v = x & 0x1fffffu;
  v = (v | v << 32) & 0x001f00000000fffful;
  v = (v | v << 16) & 0x001f0000ff0000fful;
  v = (v | v << 8) & 0x100f00f00f00f00ful;
  v = (v | v << 4) & 0x10c30c30c30c30c3ul;
  return (v | v << 2) & 0x1249249249249249ul;
}

// 63-bit codes, 21 bits an axis, x highest. One scale serves the three axes: cells are cubes,
// so that a flat scene is not cut along its thin side as often as along its long ones.
__kernel void morton_codes(__global const Box* boxes, __global const Box* bounds,
                           __global ulong* codes, __global uint* order, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const float3 lo = vec_global(bounds->lo), extent = vec_global(bounds->hi) - lo;
  const float longest = larger(extent.x, larger(extent.y, extent.z));
  const float3 at = (centre(&boxes[i]) - lo) / (longest > 0.0f ? longest : 1.0f) * 2097152.0f;
  const uint x = min((uint)larger(at.x, 0.0f), 2097151u), y = min((uint)larger(at.y, 0.0f), 2097151u),
             z = min((uint)larger(at.z, 0.0f), 2097151u);
  codes[i] = spread(x) << 2 | spread(y) << 1 | spread(z);
  order[i] = i;
}
