// A search through binary trees: for devices whose vectors are many work-items.
#ifndef FACET_SEARCH_NARROW_H
#define FACET_SEARCH_NARROW_H

#include "query.h"

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS FACET_NONE

// Depth first, the nearer child first. A node leaves at most one child waiting, so the depth of the
// trees, and one for the mark, are enough for the stack: FACET_STACK is at least that
// (host/tracer/tree.cpp), and it cannot overflow.
static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  uint waiting[FACET_STACK];
  float near_of[FACET_STACK];  // of what waits; only where t of the hit counts
  int top = 0;
  uint node = s->root;
  Interval outer = {-INFINITY, INFINITY};
  uint place = 0u;
  Sides sides = near_sides(space->slabs);
#ifndef FACET_NO_INSTANCES
  bool is_inside = false;  // in an instance's tree
  const Slabs world = space->slabs;
#endif
  for (;;) {
    bool is_leaf = true;
    while (!(node & FACET_LEAF_BIT)) {
      __global const Node* n = s->nodes + node;
      const uint4 child = *(__global const uint4*)n->child;
      Each near, far;
      child_intervals(space->slabs, sides, n->x[0], tmin, q->t, &near, &far);
      const bool is_first = near.x <= far.x, is_second = near.y <= far.y;
      is_leaf = is_first || is_second;
      if (!is_leaf) break;
      const bool is_swapped = is_first && is_second ? near.y < near.x : is_second;
      node = is_swapped ? child.y : child.x;
      if (is_first && is_second) {
        if (mode == FACET_CLOSEST) near_of[top] = is_swapped ? near.x : near.y;
        waiting[top++] = is_swapped ? child.x : child.y;
      }
    }
    if (is_leaf) {
#ifndef FACET_NO_INSTANCES
      if (!is_inside) {
        place = FACET_LEAF_FIRST(node);
        if (enter_instance(s, place, o, d, world, &outer, space)) {
          is_inside = true;
          sides = near_sides(space->slabs);
          waiting[top++] = FACET_INSTANCE_ENDS;
          node = s->instances[place].root;
          continue;
        }
        space->slabs = world;
      } else
#endif
      {
        const uint slot = FACET_LEAF_FIRST(node), count = FACET_LEAF_COUNT(node);
        for (uint k = 0; k < count; ++k)
          if (meet_triangles(s, positions, space, place, outer, slot + k, tmin, mode, q)) return;
      }
    }
    for (;;) {
      if (top == 0) return;
      node = waiting[--top];
#ifndef FACET_NO_INSTANCES
      if (node == FACET_INSTANCE_ENDS) {
        is_inside = false;
        space->slabs = world;
        sides = near_sides(world);
        continue;
      }
#endif
      if (mode != FACET_CLOSEST || near_of[top] <= q->t) break;
    }
  }
}

#endif
