// A search through binary trees: for devices whose vectors are many work-items.
#ifndef FACET_SEARCH_NARROW_H
#define FACET_SEARCH_NARROW_H

#include "query.h"

// A child that waits, as one number: the bits of its near end above the child.
static inline ulong waiting(float near, uint child) { return (ulong)as_uint(near) << 32 | child; }
static inline float near_of(ulong entry) { return as_float((uint)(entry >> 32)); }

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS ((ulong)FACET_NONE)

// Depth first, the nearer child first. A node leaves at most one child waiting, so the depth of the
// trees, and one for the mark, are enough for the stack: FACET_STACK is at least that
// (host/tracer/tree.cpp), and it cannot overflow.
static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  ulong stack[FACET_STACK];
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
      const uint2 child = *(__global const uint2*)n->child;
      Each near, far;
      child_intervals(space->slabs, sides, n->x[0], tmin, q->t, &near, &far);
      const bool is_first = near.x <= far.x, is_second = near.y <= far.y;
      is_leaf = is_first || is_second;
      if (!is_leaf) break;
      const bool is_swapped = is_first && is_second ? near.y < near.x : is_second;
      node = is_swapped ? child.y : child.x;
      if (is_first && is_second)
        stack[top++] = is_swapped ? waiting(near.x, child.x) : waiting(near.y, child.y);
    }
    if (is_leaf) {
#ifndef FACET_NO_INSTANCES
      if (!is_inside) {
        place = FACET_LEAF_FIRST(node);
        if (enter_instance(s, place, o, d, world, &outer, space)) {
          is_inside = true;
          sides = near_sides(space->slabs);
          stack[top++] = FACET_INSTANCE_ENDS;
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
    ulong entry;
    do {
      if (top == 0) return;
      entry = stack[--top];
#ifndef FACET_NO_INSTANCES
      if (entry == FACET_INSTANCE_ENDS) {
        is_inside = false;
        space->slabs = world;
        sides = near_sides(world);
      }
#endif
    } while (near_of(entry) > q->t || entry == FACET_INSTANCE_ENDS);
    node = (uint)entry;
  }
}

#endif
