// A tile of a picture: one pixel a work-item, the mean of its samples.
#include "eye.h"
#include "states.h"

__kernel void render(__global const World* world, __global const SceneNode* nodes,
                     __global const Instance* instances, __global const TriangleInfo* infos,
                     __global const Material* materials, __global Faults* faults,
                     GEOMETRY positions, GEOMETRY normals, __global const Light* lights,
                     __global const View* view,
                     __global float4* pixels, uint left, uint top, uint right, uint bottom) {
  const uint x = left + (uint)get_global_id(0), y = top + (uint)get_global_id(1);
  if (x >= right || y >= bottom) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const uint n = view->samples;
  float4 sum = (float4)(0.0f);
  for (uint j = 0; j < n; ++j)
    for (uint i = 0; i < n; ++i)
      sum = sum + radiance(&s, positions, normals, lights, view, eye_direction(view, x, y, i, j));
  pixels[(size_t)y * view->width + x] = sum / (float)(n * n);
}
