// Every triangle is tested: no tree.
#ifndef FACET_SEARCH_ALL_H
#define FACET_SEARCH_ALL_H

#include "query.h"

static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  Interval outer = {-INFINITY, INFINITY};
#ifdef FACET_NO_INSTANCES
  for (uint k = 0; k < s->triangle_count / FACET_LANES; ++k)
    if (meet_triangles(s, positions, space, 0u, outer, k, tmin, mode, q)) return;
#else
  const Slabs world = space->slabs;
  for (uint place = 0; place < s->instance_count; ++place) {
    if (!enter_instance(s, place, o, d, world, &outer, space)) continue;
    const uint first = s->instances[place].first_triangle / FACET_LANES;
    for (uint k = 0; k < s->instances[place].triangle_count / FACET_LANES; ++k)
      if (meet_triangles(s, positions, space, place, outer, first + k, tmin, mode, q)) return;
  }
#endif
}

#endif
