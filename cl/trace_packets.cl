// Rays from a buffer, hits to a buffer: FACET_PACKET rays a work-item, those together that stay close
// (search_packet.h), the others one after the other.
#include "trace_packet.h"

static inline void trace_some(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint count,
                              uint mode, __global Hit* hits, __global uint* hit_instances) {
  const uint alone = count == FACET_PACKET ? trace_packet(s, positions, rays, mode, hits, hit_instances)
                                           : (1u << count) - 1u;
  if (alone != 0u) trace_alone(s, positions, rays, alone, mode, hits, hit_instances);
}

__kernel void trace_closest(__global const World* world, __global const SceneNode* nodes,
                            __global const Instance* instances, __global const TriangleInfo* infos,
                            __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                            __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                            uint count) {
  const uint first = FACET_PACKET * (uint)get_global_id(0);
  if (first >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_some(&s, positions, rays + first, min(FACET_PACKET, count - first), FACET_CLOSEST, hits + first,
             hit_instances + first);
}

__kernel void trace_any(__global const World* world, __global const SceneNode* nodes,
                        __global const Instance* instances, __global const TriangleInfo* infos,
                        __global const Material* materials, __global Faults* faults, GEOMETRY positions,
                        __global const Ray* rays, __global Hit* hits, __global uint* hit_instances,
                        uint count) {
  const uint first = FACET_PACKET * (uint)get_global_id(0);
  if (first >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  trace_some(&s, positions, rays + first, min(FACET_PACKET, count - first), FACET_ANY, hits + first,
             hit_instances + first);
}
