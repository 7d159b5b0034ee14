// What the tests and the accuracy study ask of the functions that shading is made of: one query a
// work-item.
#define FACET_COUNT_CROSSINGS
#include "states.h"

static inline void put(__global float* to, float3 v) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}

// The surface that each ray meets, and the rays that would follow it; directions have length 1.
__kernel void probe_surfaces(__global const World* world, __global const SceneNode* nodes,
                             __global const Instance* instances, __global const TriangleInfo* infos,
                             __global const Material* materials, __global Faults* faults,
                             GEOMETRY positions, GEOMETRY normals, __global const Ray* rays,
                             __global SurfacePoint* surfaces, uint count) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const float3 o = vec_global(rays[i].origin), d = vec_global(rays[i].direction);
  const Query q = traverse(&s, positions, o, d, rays[i].tmin, rays[i].tmax, FACET_CLOSEST);
  __global SurfacePoint* out = &surfaces[i];
  out->t = q.t;
  out->u = q.u;
  out->v = q.v;
  out->triangle = q.triangle;
  out->instance = q.instance;
  out->children = 0u;
  if (q.triangle == FACET_NONE) return;

  const Surface f = surface_at(&s, positions, normals, &q, d);
  put(out->p, f.p);
  put(out->geometric, f.geometric);
  put(out->shading, f.shading);
  put(out->near_side, f.p + f.geometric * f.delta);
  put(out->far_side, f.p - f.geometric * f.delta);
  out->delta = f.delta;
  out->is_front = f.is_front;
  out->material = f.material;

  PendingRay child = {o, d, (float3)(1.0f), 0u, no_media()};
  if (!f.is_front) child.media.of[0] = f.material;
  PendingRay pending[FACET_RAY_STACK];
  uint waiting_count = 0u;
  if (branch(&s, &f, &materials[f.material], &child, pending, &waiting_count, 1u) != TRACE) return;
  for (;;) {
    const bool is_behind = dot3(child.direction, f.geometric) < 0.0f;
    out->children |= is_behind ? 2u : 1u;
    put(is_behind ? out->refracted : out->reflected, child.direction);
    put(is_behind ? out->refracted_weight : out->reflected_weight, child.throughput);
    if (waiting_count == 0u) return;
    child = pending[--waiting_count];
  }
}

// What passes along each ray, as along the way to a point light at tmax; `medium` is what surrounds
// the origins, FACET_NONE for nothing. Directions have length 1; tmin is not read.
__kernel void probe_passages(__global const World* world, __global const SceneNode* nodes,
                             __global const Instance* instances, __global const TriangleInfo* infos,
                             __global const Material* materials, __global Faults* faults,
                             GEOMETRY positions, __global const Ray* rays, __global Passage* passages,
                             uint medium, uint count) {
  const size_t i = get_global_id(0);
  if (i >= count) return;
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  const float3 o = vec_global(rays[i].origin), d = vec_global(rays[i].direction);
  const float distance = rays[i].tmax;
  const bool is_point = distance < INFINITY;
  Media media = no_media();
  media.of[0] = medium;
  const Way way = {o, d, distance, is_point, media};
  const Query q = shadow_query(&s, positions, &way);
  __global Passage* out = &passages[i];
  out->is_dark = q.triangle != FACET_NONE;
  out->entries = q.entries;
  out->exits = q.exits;
  put(out->transmittance, transmittance(&s, &way, q));
}
