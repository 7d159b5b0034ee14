// From a ray to its canonical hit: of all accepted triangles the one with the smallest (t,
// instance, triangle), whatever tree leads to it (box.h says why). Also: any hit, and all
// crossings between two points, for coloured shadows.
#ifndef FACET_TRAVERSE_H
#define FACET_TRAVERSE_H

#if defined(FACET_TREE_NONE)
#include "search_all.h"
#elif defined(FACET_WIDE)
#include "search_wide.h"
#else
#include "search_narrow.h"
#endif

// Says which triangle the closest hit is on, and where. A search keeps no more of a hit than its t and
// its place in memory: registers that it has not to hold.
static inline void finish(const Scene* s, GEOMETRY positions, float3 o, float3 d, Space* space,
                          Query* q) {
  if (q->slot == FACET_NONE) return;
  q->triangle = s->infos[q->slot].triangle;
  q->instance = instance_of(s, q->place);
#ifndef FACET_NO_INSTANCES
  __global const Instance* i = &s->instances[q->place];
  space_of(space, map_point(i->object_from_world, o), map_vector(i->object_from_world, d),
           vec_global(i->reach));
#endif
  const float2 shares = shares_in_slot(space, positions, q->slot);
  q->u = shares.x;
  q->v = shares.y;
}

// Where a query begins, and at which t; false if it has ended there. A ray that cannot be used (space.h:
// space_of), or whose tmin or tmax is NaN, meets nothing and is counted; a negative tmin counts as 0. For a miss t
// is tmax. `end`: see light.h.
static inline bool begin_query(const Scene* s, float3 o, float3 d, float tmin, float tmax, float end, Query* q,
                               Space* space, float* start) {
  q->t = tmax;
  q->place = q->slot = FACET_NONE;
  q->u = q->v = 0.0f;
  q->instance = q->triangle = FACET_NONE;
  q->depth[0] = q->depth[1] = q->depth[2] = 0;
  q->t_end = end;
#ifdef FACET_COUNT_CROSSINGS
  q->entries = q->exits = 0u;
#endif
  *start = tmin < 0.0f ? 0.0f : tmin;
  if (*start > tmax) return false;
  if (!(*start <= tmax) || !space_of(space, o, d, s->reach)) {
    atomic_inc(&s->faults->refused);
    return false;
  }
  return s->triangle_count != 0u;
}

static inline Query traverse_to(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin,
                                float tmax, float end, uint mode) {
  Query q;
  Space space;
  float start;
  if (!begin_query(s, o, d, tmin, tmax, end, &q, &space, &start)) return q;
  search(s, positions, o, d, start, mode, &space, &q);
  if (mode == FACET_CLOSEST) finish(s, positions, o, d, &space, &q);
  return q;
}

static inline Query traverse(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin,
                             float tmax, uint mode) {
  return traverse_to(s, positions, o, d, tmin, tmax, 0.0f, mode);
}

#endif
