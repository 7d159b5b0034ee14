// A ray of a buffer, and what it meets as a hit of one.
#ifndef FACET_TRACE_H
#define FACET_TRACE_H

#include "traverse.h"

// What is told of a query: of any hit, only that there is one: triangle and instance 0, at 0.
static inline void settle(Query* q, uint mode) {
  if (mode != FACET_ANY || q->triangle == FACET_NONE) return;
  q->t = 0.0f;
  q->instance = 0u;
}

static inline Query traced_query(const Scene* s, GEOMETRY positions, __global const Ray* r, uint mode) {
  Query q = traverse(s, positions, vec_global(r->origin), vec_global(r->direction), r->tmin, r->tmax, mode);
  settle(&q, mode);
  return q;
}

static inline Hit hit_of(const Query* q) {
  Hit h;
  h.t = q->t;
  h.u = q->u;
  h.v = q->v;
  h.triangle = q->triangle;
  return h;
}

static inline void write_hit(__global Hit* hits, __global uint* instances, size_t i, const Query* q) {
  hits[i] = hit_of(q);
#ifndef FACET_NO_INSTANCES
  instances[i] = q->instance;
#endif
}

#endif
