// A pixel's path as an explicit machine: what recursion would keep on the call stack is a stack of
// pending rays in private memory.
//
//   TRACE --met--> branch --child--> TRACE       one child is followed, the other is pushed
//     |              |----no child---> RESUME
//     +--missed--> escape -----------> RESUME --pending--> TRACE
//                                         +-----none-----> DONE
//
// The reflected child is followed and the refracted one pushed, so the contributions are added in
// the order of the recursion that visits reflection first, and a ray waits at most once for each
// depth: max_depth entries are enough.
#ifndef FACET_STATES_H
#define FACET_STATES_H

#include "light.h"

typedef enum { TRACE, RESUME, DONE } State;

typedef struct {
  float3 origin, direction, throughput;
  uint depth;
  Media media;  // around it
} PendingRay;

// The direction behind the surface by Snell's law, or false at total internal reflection.
// eta: index before over index behind; n against d.
static inline bool refract3(float3 d, float3 n, float eta, float3* out) {
  const float facing = -dot3(n, d);
  const float k = 1.0f - (eta * eta) * (1.0f - facing * facing);
  if (k < 0.0f) return false;
  *out = normalize3(d * eta + n * (eta * facing - sqrt(k)));
  return true;
}

static inline float3 reflect3(float3 d, float3 n) { return normalize3(d - n * (2.0f * dot3(n, d))); }

// Replaces `ray` by the child to follow and pushes the other; RESUME if there is none. A
// shading normal may send a child to the wrong side: the geometric one then takes its place. At the
// critical angle rounding may still keep a refracted ray from going behind: it is reflected.
static inline State branch(const Scene* s, const Surface* f, __global const Material* m,
                           PendingRay* ray, PendingRay* pending, uint* count, uint max_depth) {
  if (ray->depth == max_depth) return RESUME;
#ifdef FACET_SECONDARY
  const float3 d = ray->direction, step = f->geometric * f->delta;
  State next = RESUME;
  float3 kr = (float3)(0.0f);
#ifndef FACET_NO_REFLECTION
  kr = vec_global(m->Kr);
#endif
#ifndef FACET_NO_TRANSPARENCY
  PendingRay behind;
  bool is_behind = false;
  if (m->transparent) {
    const float3 kt = vec_global(m->Kt);
    float eta;
    behind.media = crossed(s, ray->media, f->material, f->is_front, &eta);
    is_behind = refract3(d, f->shading, eta, &behind.direction);
    if (is_behind && !(dot3(behind.direction, f->geometric) < 0.0f))
      is_behind = refract3(d, f->geometric, eta, &behind.direction) &&
                  dot3(behind.direction, f->geometric) < 0.0f;
    if (is_behind) {
      behind.throughput = ray->throughput * kt;
      behind.origin = f->p - step;
      behind.depth = ray->depth + 1u;
      is_behind = !is_black(behind.throughput);
    } else {
      kr = kr + kt;
    }
  }
#endif
  kr = ray->throughput * kr;
  if (!is_black(kr)) {
    float3 r = reflect3(d, f->shading);
    if (!(dot3(r, f->geometric) > 0.0f)) r = reflect3(d, f->geometric);
    ray->origin = f->p + step;
    ray->direction = r;
    ray->throughput = kr;
    ray->depth += 1u;
    next = TRACE;
  }
#ifndef FACET_NO_TRANSPARENCY
  if (is_behind) {
    if (next == TRACE)
      pending[(*count)++] = behind;
    else
      *ray = behind;
    next = TRACE;
  }
#endif
  return next;
#else
  return RESUME;
#endif
}

// A pixel's sample under way; the rays that wait lie beside it.
typedef struct {
  PendingRay ray;
  float3 sum;
  float alpha;  // 1 where something is met
  uint count;   // of rays that wait
} Path;

static inline Path path_of(__global const View* view, float3 direction) {
  const Path p = {{vec_global(view->origin), direction, (float3)(1.0f), 0u, media_of(view->media)},
                  (float3)(0.0f),
                  1.0f,
                  0u};
  return p;
}

static inline void escape(Path* p, __global const View* view) {
  p->sum = p->sum + p->ray.throughput * vec_global(view->background);
  if (p->ray.depth == 0u) p->alpha = view->background_alpha;
}

// Takes in the way to the surface that `q` tells of.
static inline Surface arrive(const Scene* s, GEOMETRY positions, GEOMETRY normals, const Query* q,
                             PendingRay* ray) {
#ifndef FACET_NO_TRANSPARENCY
  if (!is_empty(ray->media)) {
    const float3 depth = absorption(s, ray->media) * q->t;
    ray->throughput =
        ray->throughput * (float3)(exp_strict(-depth.x), exp_strict(-depth.y), exp_strict(-depth.z));
  }
#endif
  return surface_at(s, positions, normals, q, ray->direction);
}

// What a surface sends without a light. Lights' parts are added to it, in order; the sum is dimmed by the
// ray's throughput as it is added to the sample's.
static inline float3 unlit(__global const View* view, __global const Material* m) {
  return vec_global(m->Ke) + vec_global(m->Ka) * vec_global(view->ambient);
}

// What one light adds.
static inline float3 lit_from(const Scene* s, GEOMETRY positions, __global const Light* light, const Surface* f,
                              __global const Material* m, float3 d, Media media) {
  Lighting to;
  if (!faces_light(s, light, f, m, media, &to)) return (float3)(0.0f);
  return lit_by(light, &to, f, m, d, transmittance(s, &to.way, shadow_query(s, positions, &to.way)));
}

static inline State resume(Path* p, const PendingRay* pending) {
  if (p->count == 0u) return DONE;
  p->ray = pending[--p->count];
  return TRACE;
}

// The light that comes to the camera from unit direction `direction`, and alpha.
static inline float4 radiance(const Scene* s, GEOMETRY positions, GEOMETRY normals,
                              __global const Light* lights, __global const View* view,
                              float3 direction) {
  PendingRay pending[FACET_RAY_STACK];
  Path p = path_of(view, direction);
  // One turn takes each pixel of a warp from one ray to its next, so that all trace at once: a turn for each
  // state would have some trace while others shade.
  for (State state = TRACE; state != DONE;) {
    const Query q = traverse(s, positions, p.ray.origin, p.ray.direction, 0.0f, INFINITY, FACET_CLOSEST);
    if (q.triangle == FACET_NONE) {
      escape(&p, view);
      state = RESUME;
    } else {
      const Surface f = arrive(s, positions, normals, &q, &p.ray);
      __global const Material* m = &s->materials[f.material];
      float3 lit = unlit(view, m);
      for (uint i = 0; i < view->light_count; ++i)
        lit = lit + lit_from(s, positions, &lights[i], &f, m, p.ray.direction, p.ray.media);
      p.sum = p.sum + p.ray.throughput * lit;
      state = branch(s, &f, m, &p.ray, pending, &p.count, view->max_depth);
    }
    if (state == RESUME) state = resume(&p, pending);
  }
  return (float4)(p.sum, p.alpha);
}

#endif
