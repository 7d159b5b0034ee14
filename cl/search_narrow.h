// A search through trees of four children a node.
#ifndef FACET_SEARCH_NARROW_H
#define FACET_SEARCH_NARROW_H

#include "query.h"

// A child that waits, as one number that sorts by distance: the near end's bits, which order as
// the floats do because tmin is at least 0, above the child. Absent ones sort last.
#define FACET_ABSENT (~0ul)
static inline ulong waiting(float near, float far, uint child) {
  return near <= far ? (ulong)as_uint(near) << 32 | child : FACET_ABSENT;
}
static inline float near_of(ulong entry) { return as_float((uint)(entry >> 32)); }

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS ((ulong)FACET_NONE)

// Depth first, the nearest child first. A node leaves at most three children waiting, so three times
// the depth of the trees, and one for the mark, are enough for the stack: FACET_STACK is at least
// that (host/tracer/tree.cpp), and it cannot overflow.
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
      const uint4 child = *(__global const uint4*)n->child;
      Each near, far;
      child_intervals(space->slabs, sides, n->x[0], tmin, q->t, &near, &far);
      ulong a = waiting(near.x, far.x, child.x), b = waiting(near.y, far.y, child.y),
            c = waiting(near.z, far.z, child.z), e = waiting(near.w, far.w, child.w);
      // A sorting network: a <= b <= c <= e.
      const ulong ab = min(a, b), ba = max(a, b), ce = min(c, e), ec = max(c, e);
      a = min(ab, ce), e = max(ba, ec);
      const ulong p = max(ab, ce), r = min(ba, ec);
      b = min(p, r), c = max(p, r);
      if (e != FACET_ABSENT) stack[top++] = e;
      if (c != FACET_ABSENT) stack[top++] = c;
      if (b != FACET_ABSENT) stack[top++] = b;
      is_leaf = a != FACET_ABSENT;
      if (!is_leaf) break;
      node = (uint)a;
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
