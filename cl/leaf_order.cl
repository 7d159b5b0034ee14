#include "leaf_order.h"

// i counts from the mesh's first triangle.
__kernel void gather_triangles(__global const uint* order, __global const float4* corners,
                               __global const uint* materials, __global float4* corners_out,
                               __global TriangleInfo* infos, uint count, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  put_triangle(corners, materials, order[i], corners_out, infos, (size_t)slot_offset + i);
}

__kernel void gather_normals(__global const uint* order, __global const float4* normals,
                             __global float4* normals_out, uint count, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const size_t to = (size_t)slot_offset + i;
  for (size_t c = 0; c < 3; ++c) normals_out[3 * to + c] = normals[3 * (size_t)order[i] + c];
}
