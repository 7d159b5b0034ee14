// Triangles of a mesh whose vertices have moved, written into the slots that they have.
//
// A triangle without an area is a point (host/scene/shut.hpp), unless it closes a seam: that is for the host to
// find out, of those that are listed here because rounding leaves it open whether they have one.
#include "blocks.h"

// Lanes' coordinate, of eight corners.
#define LANES(p, axis) \
  (float8)(p[0].axis, p[1].axis, p[2].axis, p[3].axis, p[4].axis, p[5].axis, p[6].axis, p[7].axis)

typedef struct {
  float3 p[3];
} Corners;

// shut: a bit a triangle, if there are any.
static inline bool is_shut(__global const uint* shut, uint has_shut, uint triangle) {
  return has_shut != 0u && (shut[triangle >> 5] >> (triangle & 31u) & 1u) != 0u;
}

static inline Corners corners_of(__global const uint* indices, __global const float* positions,
                                 __global const uint* shut, uint has_shut, uint triangle) {
  const uint3 v = vload3(triangle, indices);
  Corners c;
  c.p[0] = c.p[1] = c.p[2] = vload3(v.x, positions);
  if (is_shut(shut, has_shut, triangle)) return c;
  c.p[1] = vload3(v.y, positions);
  c.p[2] = vload3(v.z, positions);
  return c;
}

// a * b - c * d is off by less than 5 u (|a b| + |c d|), a to d being rounded differences, u = 2^-24, and what
// underflows is far below 2^-100.
static inline bool is_surely_not_0(float a, float b, float c, float d) {
  const float ab = a * b, cd = c * d;
  return fabs(ab - cd) > 0x1p-20f * (fabs(ab) + fabs(cd)) + 0x1p-100f;
}

static inline bool surely_has_area(Corners c) {
  const float3 e = c.p[1] - c.p[0], f = c.p[2] - c.p[0];
  return is_surely_not_0(e.y, f.z, e.z, f.y) || is_surely_not_0(e.z, f.x, e.x, f.z) ||
         is_surely_not_0(e.x, f.y, e.y, f.x);
}

// unsure: how many triangles may have no area, and the first `room` of them in any order. Nothing is listed
// where the host knows already.
static inline void list_if_unsure(__global uint* unsure, uint room, uint has_shut, uint triangle, Corners c) {
  if (has_shut != 0u || surely_has_area(c)) return;
  const uint at = atomic_inc((volatile __global uint*)unsure);
  if (at < room) unsure[1u + at] = triangle;
}

// indices: three vertices a triangle; positions: three floats a vertex. Of `count` slots from first_slot on.
__kernel void move_triangles(__global const uint* indices, __global const float* positions,
                             __global const TriangleInfo* infos, __global const uint* shut,
                             __global float4* corners, __global uint* unsure, uint room, uint has_shut,
                             uint first_slot, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const size_t slot = (size_t)first_slot + i;
  const uint triangle = infos[slot].triangle;
  const Corners c = corners_of(indices, positions, shut, has_shut, triangle);
  list_if_unsure(unsure, room, has_shut, triangle, c);
  for (uint k = 0u; k < 3u; ++k) corners[3u * slot + k] = (float4)(c.p[k], 0.0f);
}

// So many blocks ahead a block's vertices are asked for, which are read from all over the mesh, and twice as many
// ahead their indices.
#define AHEAD 6u

static inline void fetch_indices(__global const uint* indices, __global const TriangleInfo* info) {
  for (uint lane = 0u; lane < FACET_BLOCK; ++lane) {
    __global const uint* v = &indices[3u * (size_t)info[lane].triangle];
    fetch_lines(v, sizeof(uint));
    fetch_lines(v + 2, sizeof(uint));
  }
}

static inline void fetch_vertices(__global const uint* indices, __global const float* positions,
                                  __global const TriangleInfo* info) {
  for (uint lane = 0u; lane < FACET_BLOCK; ++lane) {
    const uint3 v = vload3(info[lane].triangle, indices);
    fetch_lines(&positions[3u * (size_t)v.x], sizeof(float));
    fetch_lines(&positions[3u * (size_t)v.y], sizeof(float));
    fetch_lines(&positions[3u * (size_t)v.z], sizeof(float));
  }
}

// The same in the wide layout: a work-item makes `run` of `count` blocks in a row. A lane that is not the first
// and has the first one's triangle is absent.
__kernel void move_blocks(__global const uint* indices, __global const float* positions,
                          __global const TriangleInfo* infos, __global const uint* shut,
                          __global float4* blocks, __global uint* unsure, uint room, uint has_shut,
                          uint first_block, uint count, uint run) {
  const ulong first = get_global_id(0) * (ulong)run;
  const uint end = (uint)min(first + run, (ulong)count);
  for (uint i = (uint)min(first, (ulong)count); i < end; ++i) {
    const size_t block = (size_t)first_block + i;
    __global const TriangleInfo* info = &infos[FACET_BLOCK * block];
    if (i + 2u * AHEAD < end) fetch_indices(indices, info + 2u * AHEAD * FACET_BLOCK);
    if (i + AHEAD < end) fetch_vertices(indices, positions, info + AHEAD * FACET_BLOCK);
    float3 p[3][FACET_BLOCK];
    for (uint lane = 0u; lane < FACET_BLOCK; ++lane) {
      const uint triangle = info[lane].triangle;
      if (lane > 0u && triangle == info[0].triangle) {
        for (uint k = 0u; k < 3u; ++k) p[k][lane] = p[absent_corner(k, p[0][0], p[1][0])][0];
        continue;
      }
      const Corners c = corners_of(indices, positions, shut, has_shut, triangle);
      list_if_unsure(unsure, room, has_shut, triangle, c);
      for (uint k = 0u; k < 3u; ++k) p[k][lane] = c.p[k];
    }
    __global float8* to = (__global float8*)(blocks + 18u * block);
    for (uint k = 0u; k < 3u; ++k) {
      STORE_PAST_CACHES(LANES(p[k], x), &to[3u * k]);
      STORE_PAST_CACHES(LANES(p[k], y), &to[3u * k + 1u]);
      STORE_PAST_CACHES(LANES(p[k], z), &to[3u * k + 2u]);
    }
  }
}

// Three a slot, in either layout.
__kernel void move_normals(__global const uint* indices, __global const float* normals,
                           __global const TriangleInfo* infos, __global float4* normals_out, uint first_slot,
                           uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const size_t slot = (size_t)first_slot + i;
  const uint3 n = vload3(infos[slot].triangle, indices);
  normals_out[3u * slot] = (float4)(vload3(n.x, normals), 0.0f);
  normals_out[3u * slot + 1u] = (float4)(vload3(n.y, normals), 0.0f);
  normals_out[3u * slot + 2u] = (float4)(vload3(n.z, normals), 0.0f);
}
