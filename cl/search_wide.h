// A search through trees of eight children a node, triangles in blocks of eight: for devices whose
// vectors lie within a work-item.
#ifndef FACET_SEARCH_WIDE_H
#define FACET_SEARCH_WIDE_H

#include "query.h"

// A child that waits, as one number that sorts by distance: the near end's bits, which order as
// the floats do because tmin is at least 0, above the child.
static inline ulong waiting(const float* near, __global const uint* child, uint lane) {
  return (ulong)as_uint(near[lane]) << 32 | child[lane];
}
static inline float near_of(ulong entry) { return as_float((uint)(entry >> 32)); }

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS ((ulong)FACET_NONE)

// Puts the children in `lanes` on the stack, the farthest first, and gives the nearest.
static inline uint push_children(__global const uint* child, uint lanes, Each near, ulong* stack,
                                 int* top) {
  const uint first = first_lane(lanes);
  lanes = without_first(lanes);
  if (lanes == 0u) return child[first];
  float at[8];
  vstore8(near, 0, at);
  ulong nearest = waiting(at, child, first);
  const int base = *top;
  for (; lanes != 0u; lanes = without_first(lanes)) {
    const ulong next = waiting(at, child, first_lane(lanes));
    const ulong farther = max(nearest, next);
    nearest = min(nearest, next);
    int k = (*top)++;
    for (; k > base && stack[k - 1] < farther; --k) stack[k] = stack[k - 1];
    stack[k] = farther;
  }
  return (uint)nearest;
}

// Depth first, the nearest child first. A node leaves at most seven children waiting, so seven times
// the depth of the trees, and one for the mark, are enough for the stack: FACET_STACK is at least
// that (host/tracer/wide_geometry.cpp), and it cannot overflow.
static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  ulong stack[FACET_STACK];
  int top = 0;
  uint node = s->root;
  Interval outer = {-INFINITY, INFINITY};
  uint place = 0u;
  Sides side = near_sides(space->slabs);
#ifndef FACET_NO_INSTANCES
  bool is_inside = false;  // in an instance's tree
  const Slabs world = space->slabs;
#endif
  for (;;) {
    if (!(node & FACET_LEAF_BIT)) {
      __global const Each* faces = (__global const Each*)(s->nodes + node);
      Each near, far;
      child_intervals(space->slabs, side, faces, tmin, q->t, &near, &far);
      const uint lanes = lanes_of(near <= far);
      if (lanes != 0u) {
        node = push_children((__global const uint*)(faces + 6), lanes, near, stack, &top);
        continue;
      }
#ifndef FACET_NO_INSTANCES
    } else if (!is_inside) {
      place = FACET_LEAF_FIRST(node);
      if (enter_instance(s, place, o, d, world, &outer, space)) {
        is_inside = true;
        side = near_sides(space->slabs);
        stack[top++] = FACET_INSTANCE_ENDS;
        node = s->instances[place].root;
        continue;
      }
      space->slabs = world;
#endif
    } else if (meet_triangles(s, positions, space, place, outer, FACET_BLOCK * FACET_LEAF_FIRST(node),
                              tmin, mode, q)) {
      return;
    }
    ulong entry;
    do {
      if (top == 0) return;
      entry = stack[--top];
#ifndef FACET_NO_INSTANCES
      if (entry == FACET_INSTANCE_ENDS) {
        is_inside = false;
        space->slabs = world;
        side = near_sides(world);
      }
#endif
    } while (near_of(entry) > q->t || entry == FACET_INSTANCE_ENDS);
    node = (uint)entry;
  }
}

#endif
