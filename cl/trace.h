// A ray of a buffer, and what it meets as a hit of one.
#ifndef FACET_TRACE_H
#define FACET_TRACE_H

#include "traverse.h"

static inline Query traced_query(const Scene* s, GEOMETRY positions, __global const Ray* r, uint mode) {
  Query q = traverse(s, positions, vec_global(r->origin), vec_global(r->direction), r->tmin, r->tmax, mode);
  // Of any hit, only that there is one: triangle and instance 0, at 0.
  if (mode == FACET_ANY && q.triangle != FACET_NONE) {
    q.t = 0.0f;
    q.instance = 0u;
  }
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

#endif
