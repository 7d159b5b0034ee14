// Rays of a picture as trees in memory, one a sample: rays of one depth lie together, and each knows those that
// follow it. So all of a depth are traced by one launch, and shaded by another, and yet a sample's light is added
// up in the order of states.h, which follows one ray to its end.
#ifndef FACET_RAY_TREE_H
#define FACET_RAY_TREE_H

#include "media.h"

// Of each ray, as structures of arrays: a warp reads 16 bytes a work-item at once.
typedef struct {
  __global float4* origins;
  __global float4* directions;
  __global float4* throughputs;
  __global uint* media;  // FACET_NESTING a ray
} RayLists;

static inline RayLists ray_lists(__global float4* origins, __global float4* directions,
                                 __global float4* throughputs, __global uint* media) {
  const RayLists l = {origins, directions, throughputs, media};
  return l;
}

static inline void put_ray(const RayLists* l, uint i, float3 origin, float3 direction, float3 throughput,
                           Media media) {
  l->origins[i] = (float4)(origin, 0.0f);
  l->directions[i] = (float4)(direction, 0.0f);
  l->throughputs[i] = (float4)(throughput, 0.0f);
#ifndef FACET_NO_TRANSPARENCY
  for (int k = 0; k < FACET_NESTING; ++k) l->media[FACET_NESTING * i + k] = media.of[k];
#endif
}

static inline Media media_at(const RayLists* l, uint i) {
#ifdef FACET_NO_TRANSPARENCY
  return no_media();
#else
  return media_of(l->media + FACET_NESTING * i);
#endif
}

// A ray that none follows.
static inline RayNode ray_node(float3 light, float alpha) {
  RayNode n;
  n.light[0] = light.x, n.light[1] = light.y, n.light[2] = light.z;
  n.alpha = alpha;
  n.first = n.second = FACET_NONE;
  return n;
}

// Where this work-item's `mine` entries go in a list that all groups append to, whose length grows by them. All of a
// group come here.
static inline uint appended(uint mine, __local uint* pool, volatile __global uint* length) {
  const bool is_first = get_local_id(0) == 0;
  if (is_first) pool[0] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint at = mine == 0u ? 0u : atomic_add(&pool[0], mine);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (is_first) pool[1] = atomic_add(length, pool[0]);
  barrier(CLK_LOCAL_MEM_FENCE);
  return pool[1] + at;
}

#endif
