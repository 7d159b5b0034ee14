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

// Asks for what waits: it is read after all that lies before it. A node has 256 bytes; a block's last 32 are
// left out, so that both are asked for alike. For a leaf of the top tree, whose index is an instance's,
// some block comes, or nothing.
static inline void fetch_child(const Scene* s, GEOMETRY positions, uint child) {
  __global const void* node = s->nodes + child;
  __global const void* block = triangles_from(positions, FACET_LEAF_FIRST(child)).first;
  fetch_lines(child & FACET_LEAF_BIT ? block : node, sizeof(WideNode));
}

// Puts the children in `lanes` on the stack, the farthest first, and gives the nearest. Few nodes have
// more than two, most of them one: those come before any loop.
static inline uint push_children(const Scene* s, GEOMETRY positions, __global const uint* child,
                                 uint lanes, Each near, ulong* stack, int* top) {
  const uint first = first_lane(lanes);
  lanes = without_first(lanes);
  if (lanes == 0u) return child[first];
  float at[8];
  vstore8(near, 0, at);
  const ulong a = waiting(at, child, first), b = waiting(at, child, first_lane(lanes));
  fetch_child(s, positions, (uint)a);
  fetch_child(s, positions, (uint)b);
  ulong nearest = min(a, b);
  const int base = *top;
  stack[(*top)++] = max(a, b);
  for (lanes = without_first(lanes); lanes != 0u; lanes = without_first(lanes)) {
    const ulong next = waiting(at, child, first_lane(lanes));
    fetch_child(s, positions, (uint)next);
    const ulong farther = max(nearest, next);
    nearest = min(nearest, next);
    int k = (*top)++;
    for (; k > base && stack[k - 1] < farther; --k) stack[k] = stack[k - 1];
    stack[k] = farther;
  }
  return (uint)nearest;
}

// The same in no order, where t of the hit does not matter: none of them is culled later.
static inline uint push_unsorted(const Scene* s, GEOMETRY positions, __global const uint* child,
                                 uint lanes, ulong* stack, int* top) {
  const uint first = first_lane(lanes);
  for (lanes = without_first(lanes); lanes != 0u; lanes = without_first(lanes)) {
    const uint next = child[first_lane(lanes)];
    fetch_child(s, positions, next);
    stack[(*top)++] = next;
  }
  return child[first];
}

// Depth first, the nearest child first. A node leaves at most seven children waiting, so seven times
// the depth of the trees, and one for the mark, are enough for the stack: FACET_STACK is at least
// that (host/tracer/wide_geometry.cpp), and it cannot overflow.
//
// It begins at a node of the tree of the instance at `place`, whose box the ray meets in `outer`, or of the
// world's (place FACET_NONE); `space` is the ray's there, o and d are the ray in the world.
static inline void search_from(const Scene* s, GEOMETRY positions, uint node, uint place, Interval outer,
                               float3 o, float3 d, float tmin, uint mode, Space* space, Query* q) {
  ulong stack[FACET_STACK];
  int top = 0;
  Sides sides = near_sides(space->slabs);
#ifdef FACET_NO_INSTANCES
  place = 0u;
#else
  bool is_inside = place != FACET_NONE;
  const Slabs world = space->slabs;
#endif
  for (;;) {
    if (!(node & FACET_LEAF_BIT)) {
      __global const WideNode* n = s->nodes + node;
      Each near, far;
      child_intervals(space->slabs, sides, n->x[0], tmin, q->t, &near, &far);
      const uint lanes = lanes_of(near <= far);
      if (lanes != 0u) {
        node = mode == FACET_CLOSEST
                   ? push_children(s, positions, n->child, lanes, near, stack, &top)
                   : push_unsorted(s, positions, n->child, lanes, stack, &top);
        continue;
      }
#ifndef FACET_NO_INSTANCES
    } else if (!is_inside) {
      place = FACET_LEAF_FIRST(node);
      if (enter_instance(s, place, o, d, world, &outer, space)) {
        is_inside = true;
        sides = near_sides(space->slabs);
        stack[top++] = FACET_INSTANCE_ENDS;
        node = s->instances[place].root;
        continue;
      }
#endif
    } else if (meet_triangles(s, positions, space, place, outer, FACET_LEAF_FIRST(node),
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
        sides = near_sides(world);
      }
#endif
    } while (near_of(entry) > q->t || entry == FACET_INSTANCE_ENDS);
    node = (uint)entry;
  }
}

static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  const Interval outer = {-INFINITY, INFINITY};
  search_from(s, positions, s->root, FACET_NONE, outer, o, d, tmin, mode, space, q);
}

#endif
