// As trace.cl, but a warp's work-items take one ray after the other.
#include "refill.h"

__kernel void trace_closest(__global const World* world, __global const SceneNode* nodes,
                            __global const Instance* instances, __global const TriangleInfo* infos,
                            __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                            __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                            uint count, volatile __global uint* next) {
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_refilled(&s, positions, rays, hits, hit_instances, FACET_CLOSEST, supply_of(count, next));
}

__kernel void trace_any(__global const World* world, __global const SceneNode* nodes,
                        __global const Instance* instances, __global const TriangleInfo* infos,
                        __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                        __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                        uint count, volatile __global uint* next) {
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_refilled(&s, positions, rays, hits, hit_instances, FACET_ANY, supply_of(count, next));
}

// How evenly rays that each have a work-item to themselves would share the steps of a warp.
__kernel void sample_closest(__global const World* world, __global const SceneNode* nodes,
                             __global const Instance* instances, __global const TriangleInfo* infos,
                             __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                             __global const Ray* rays, uint apart, volatile __global uint* sums) {
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  sample_steps(&s, positions, rays, apart, sums);
}
