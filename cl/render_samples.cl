// A tile of a picture, one sample of a pixel a work-item: where they are many more than run at once, and a launch ends
// with its longest, a pixel's samples one after the other would end last.
//
// Neighbours among all samples are neighbours in a work-group.
#include "eye.h"
#include "states.h"

// Sample (x, y) of the tile's grid of samples is at samples[y * its columns + x].
__kernel void render_samples(__global const World* world, __global const SceneNode* nodes,
                             __global const Instance* instances, __global const TriangleInfo* infos,
                             __global const Material* materials, __global Faults* faults,
                             GEOMETRY positions, GEOMETRY normals, __global const Light* lights,
                             __global const View* view, __global float4* samples, uint left, uint top,
                             uint right, uint bottom) {
  const uint x = (uint)get_global_id(0), y = (uint)get_global_id(1);
  const uint n = view->samples, columns = n * (right - left);
  if (x >= columns || y >= n * (bottom - top)) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const float3 direction = eye_direction(view, left + x / n, top + y / n, x % n, y % n);
  samples[(size_t)y * columns + x] = radiance(&s, positions, normals, lights, view, direction);
}

// The mean of each pixel's, in the order of render.cl.
__kernel void mean_samples(__global const View* view, __global const float4* samples, __global float4* pixels,
                           uint left, uint top, uint right, uint bottom) {
  const uint x = (uint)get_global_id(0), y = (uint)get_global_id(1);
  if (x >= right - left || y >= bottom - top) return;
  const uint n = view->samples, columns = n * (right - left);
  float4 sum = (float4)(0.0f);
  for (uint j = 0u; j < n; ++j)
    for (uint i = 0u; i < n; ++i) sum = sum + samples[(size_t)(n * y + j) * columns + n * x + i];
  pixels[(size_t)(top + y) * view->width + left + x] = sum / (float)(n * n);
}
