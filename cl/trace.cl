// Rays from a buffer, hits to a buffer: one ray a work-item.
#include "trace.h"

__kernel void trace_closest(__global const World* world, __global const SceneNode* nodes,
                            __global const Instance* instances, __global const TriangleInfo* infos,
                            __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                            __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                            uint count) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const Query q = traced_query(&s, positions, rays + i, FACET_CLOSEST);
  write_hit(hits, hit_instances, i, &q);
}

// Only whether something is met: triangle and instance 0 if so.
__kernel void trace_any(__global const World* world, __global const SceneNode* nodes,
                        __global const Instance* instances, __global const TriangleInfo* infos,
                        __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                        __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                        uint count) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const Query q = traced_query(&s, positions, rays + i, FACET_ANY);
  write_hit(hits, hit_instances, i, &q);
}
