// A tile of a picture: FACET_PACKET pixels a work-item, which go through the states of states.h in step, so that
// the rays of each step can be traced together. What a pixel adds up, and in which order, is as in render.cl.
#include "eye.h"
#include "states.h"
#include "together.h"

// Paths of pixels of one work-item, those in `which`, each until its end.
typedef struct {
  Path path[FACET_PACKET];
  PendingRay pending[FACET_PACKET][FACET_RAY_STACK];
  Surface surface[FACET_PACKET];
  float3 lit[FACET_PACKET];  // what that surface sends
} Paths;

static inline void trace_paths(const Scene* s, GEOMETRY positions, const Paths* p, uint which, Query* found) {
  Bundle rays;
  rays.which = 0u;
  for (; which != 0u; which = without_first(which)) {
    const uint i = first_lane(which);
    put_ray(&rays, i, p->path[i].ray.origin, p->path[i].ray.direction, INFINITY, 0.0f);
  }
  trace_together(s, positions, &rays, FACET_CLOSEST, found);
}

// Adds one light's part to the paths that stand at a surface.
static inline void light_paths(const Scene* s, GEOMETRY positions, __global const Light* light, Paths* p,
                               uint which) {
  Lighting to[FACET_PACKET];
  Query found[FACET_PACKET];
  Bundle rays;
  rays.which = 0u;
  for (uint left = which; left != 0u; left = without_first(left)) {
    const uint i = first_lane(left);
    const Surface* f = &p->surface[i];
    if (!faces_light(s, light, f, &s->materials[f->material], p->path[i].ray.media, &to[i])) continue;
    const Way* way = &to[i].way;
    put_ray(&rays, i, way->start, way->direction, way->distance, end_of(way));
  }
  trace_together(s, positions, &rays, FACET_SHADOWS, found);
  for (uint left = rays.which; left != 0u; left = without_first(left)) {
    const uint i = first_lane(left);
    const Surface* f = &p->surface[i];
    p->lit[i] = p->lit[i] + lit_by(light, &to[i], f, &s->materials[f->material], p->path[i].ray.direction,
                                   transmittance(s, &to[i].way, found[i]));
  }
}

static inline void follow_paths(const Scene* s, GEOMETRY positions, GEOMETRY normals,
                                __global const Light* lights, __global const View* view, Paths* p,
                                uint which) {
  while (which != 0u) {
    Query found[FACET_PACKET];
    trace_paths(s, positions, p, which, found);
    uint shaded = 0u;
    for (uint left = which; left != 0u; left = without_first(left)) {
      const uint i = first_lane(left);
      if (found[i].triangle == FACET_NONE) {
        escape(&p->path[i], view);
      } else {
        p->surface[i] = arrive(s, positions, normals, &found[i], &p->path[i].ray);
        p->lit[i] = unlit(view, &s->materials[p->surface[i].material]);
        shaded |= 1u << i;
      }
    }
    if (shaded != 0u)
      for (uint k = 0u; k < view->light_count; ++k) light_paths(s, positions, &lights[k], p, shaded);
    for (uint left = which; left != 0u; left = without_first(left)) {
      const uint i = first_lane(left);
      Path* path = &p->path[i];
      const Surface* f = &p->surface[i];
      State next = RESUME;
      if (shaded >> i & 1u) {
        path->sum = path->sum + path->ray.throughput * p->lit[i];
        next = branch(s, f, &s->materials[f->material], &path->ray, p->pending[i], &path->count,
                      view->max_depth);
      }
      if (next == RESUME && resume(path, p->pending[i]) == DONE) which &= ~(1u << i);
    }
  }
}

__kernel void render(__global const World* world, __global const SceneNode* nodes,
                     __global const Instance* instances, __global const TriangleInfo* infos,
                     __global const Material* materials, __global Faults* faults,
                     GEOMETRY positions, GEOMETRY normals, __global const Light* lights,
                     __global const View* view,
                     __global float4* pixels, uint left, uint top, uint right, uint bottom) {
  const uint x = left + FACET_PACKET_COLUMNS * (uint)get_global_id(0);
  const uint y = top + FACET_PACKET_ROWS * (uint)get_global_id(1);
  const Scene s = scene_of(world, nodes, instances, infos, materials, faults);
  uint which = 0u;
  for (uint i = 0u; i < FACET_PACKET; ++i)
    if (x + i % FACET_PACKET_COLUMNS < right && y + i / FACET_PACKET_COLUMNS < bottom) which |= 1u << i;
  if (which == 0u) return;
  const uint n = view->samples;
  float4 sum[FACET_PACKET];
  for (uint i = 0u; i < FACET_PACKET; ++i) sum[i] = (float4)(0.0f);
  Paths paths;
  for (uint k = 0u; k < n * n; ++k) {
    for (uint each = which; each != 0u; each = without_first(each)) {
      const uint i = first_lane(each);
      paths.path[i] = path_of(view, eye_direction(view, x + i % FACET_PACKET_COLUMNS,
                                                  y + i / FACET_PACKET_COLUMNS, k % n, k / n));
    }
    follow_paths(&s, positions, normals, lights, view, &paths, which);
    for (uint each = which; each != 0u; each = without_first(each)) {
      const uint i = first_lane(each);
      sum[i] = sum[i] + (float4)(paths.path[i].sum, paths.path[i].alpha);
    }
  }
  for (; which != 0u; which = without_first(which)) {
    const uint i = first_lane(which);
    const size_t at = (size_t)(y + i / FACET_PACKET_COLUMNS) * view->width + x + i % FACET_PACKET_COLUMNS;
    pixels[at] = sum[i] / (float)(n * n);
  }
}
