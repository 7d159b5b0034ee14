// Triangles in blocks, a leaf each (layout.h: TriangleBlock), and what belongs to their slots.
#include "blocks.h"

// So many blocks ahead a leaf's triangles are asked for: they are read from all over the mesh.
#define AHEAD 6u

static inline uint lane_triangle(__global const uint* order, uint leaf, uint lane) {
  return order[FACET_LEAF_FIRST(leaf) + (lane < FACET_LEAF_COUNT(leaf) ? lane : 0u)];
}

static inline void fetch_leaf(__global const uint* order, __global const float4* corners,
                              __global const uint* materials, uint leaf) {
  for (uint lane = 0u; lane < FACET_LEAF_COUNT(leaf); ++lane) {
    const size_t triangle = order[FACET_LEAF_FIRST(leaf) + lane];
    // Three corners may lie across two lines.
    fetch_lines(&corners[3u * triangle], sizeof(float4));
    fetch_lines(&corners[3u * triangle + 2u], sizeof(float4));
    fetch_lines(&materials[triangle], sizeof(uint));
  }
}

// leaves[i], of `count`, is block first_block + i: its triangles, as places of `order`. A work-item makes
// `run` blocks in a row. Blocks are 18 float4 each.
__kernel void make_blocks(__global const uint* leaves, __global const uint* order,
                          __global const float4* corners, __global const uint* materials,
                          __global float4* blocks, __global TriangleInfo* infos, uint count, uint run,
                          uint first_block) {
  const ulong first = get_global_id(0) * (ulong)run;
  const uint end = (uint)min(first + run, (ulong)count);
  for (uint i = (uint)min(first, (ulong)count); i < end; ++i) {
    if (i + AHEAD < end) fetch_leaf(order, corners, materials, leaves[i + AHEAD]);
    const uint leaf = leaves[i], present = FACET_LEAF_COUNT(leaf);
#define TRIANGLE(lane) lane_triangle(order, leaf, lane)
    const size_t triangle[FACET_BLOCK] = {OF_LANES(TRIANGLE)};
    const float3 p0 = corners[3u * triangle[0]].xyz, p1 = corners[3u * triangle[0] + 1u].xyz;

    const size_t block = (size_t)first_block + i;
    __global float8* to = (__global float8*)(blocks + 18u * block);
    for (uint k = 0u; k < 3u; ++k) {
      const uint absent = absent_corner(k, p0, p1);
#define CORNER(lane) corners[3u * triangle[lane] + ((lane) < present ? k : absent)]
      const float4 p[FACET_BLOCK] = {OF_LANES(CORNER)};
      float8 x, y, z;
      lanes_from(p, &x, &y, &z);
      STORE_PAST_CACHES(x, &to[3u * k]);
      STORE_PAST_CACHES(y, &to[3u * k + 1u]);
      STORE_PAST_CACHES(z, &to[3u * k + 2u]);
    }
#define INFO(lane) (uint)triangle[lane], materials[triangle[lane]]
    STORE_PAST_CACHES((uint16)(OF_LANES(INFO)), (__global uint16*)(infos + FACET_BLOCK * block));
  }
}

__kernel void block_normals(__global const uint* leaves, __global const uint* order,
                            __global const float4* normals, __global float4* normals_out, uint count,
                            uint run, uint first_block) {
  const ulong first = get_global_id(0) * (ulong)run;
  const uint end = (uint)min(first + run, (ulong)count);
  for (uint i = (uint)min(first, (ulong)count); i < end; ++i) {
    const size_t slot = FACET_BLOCK * ((size_t)first_block + i);
    for (uint lane = 0u; lane < FACET_BLOCK; ++lane)
      for (uint k = 0u; k < 3u; ++k)
        normals_out[3u * (slot + lane) + k] =
            normals[3u * (size_t)lane_triangle(order, leaves[i], lane) + k];
  }
}
