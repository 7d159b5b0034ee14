// A search through binary trees: for devices whose vectors are many work-items.
#ifndef FACET_SEARCH_NARROW_H
#define FACET_SEARCH_NARROW_H

#include "query.h"
#include "warp.h"

// A mark on the stack: below it lies what waits in the world, above it an instance's tree.
#define FACET_INSTANCE_ENDS FACET_NONE

// What waits is on a stack: children, and where t of the hit counts their near ends. A node leaves at most
// one waiting, so the depth of the trees, and one for the mark, are enough for it: FACET_STACK is at least
// that (host/tracer/tree.cpp), and it cannot overflow. Arrays, not a structure: NVIDIA's compiler makes 5%
// slower code of that.

// The nearer of a node's children that are to be visited, the other one waits; FACET_NONE if none is.
static inline uint visit_node(const Scene* s, uint node, const Space* space, Sides sides, float tmin,
                              float best, uint mode, uint* waiting, float* near_of, int* top) {
  __global const Node* n = s->nodes + node;
  const uint4 child = *(__global const uint4*)n->child;
  Each near, far;
  child_intervals(space->slabs, sides, n->x[0], tmin, best, &near, &far);
  const bool is_first = near.x <= far.x, is_second = near.y <= far.y;
  if (!is_first && !is_second) return FACET_NONE;
  const bool is_swapped = is_first && is_second ? near.y < near.x : is_second;
  if (is_first && is_second) {
    if (mode == FACET_CLOSEST) near_of[*top] = is_swapped ? near.x : near.y;
    waiting[(*top)++] = is_swapped ? child.x : child.y;
  }
  return is_swapped ? child.y : child.x;
}

// True if the query is answered.
static inline bool meet_leaf(const Scene* s, GEOMETRY positions, const Space* space, uint place,
                             Interval outer, uint leaf, float tmin, uint mode, Query* q) {
  const uint slot = FACET_LEAF_FIRST(leaf), count = FACET_LEAF_COUNT(leaf);
  for (uint k = 0; k < count; ++k)
    if (meet_triangles(s, positions, space, place, outer, slot + k, tmin, mode, q)) return true;
  return false;
}

#ifndef FACET_NO_INSTANCES
// The root of an instance's tree, once the ray is taken into it and the stack marked; FACET_NONE if the ray
// cannot meet it.
static inline uint enter_tree(const Scene* s, uint place, float3 o, float3 d, const Slabs world,
                              Interval* outer, Space* space, Sides* sides, uint* waiting, int* top) {
  if (!enter_instance(s, place, o, d, world, outer, space)) return FACET_NONE;
  *sides = near_sides(space->slabs);
  waiting[(*top)++] = FACET_INSTANCE_ENDS;
  return s->instances[place].root;
}
#endif

// Depth first, the nearer child first.
static inline void search_in_order(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                                   Space* space, Query* q) {
  uint waiting[FACET_STACK];
  float near_of[FACET_STACK];
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
    while (!(node & FACET_LEAF_BIT))
      node = visit_node(s, node, space, sides, tmin, q->t, mode, waiting, near_of, &top);
    if (node != FACET_NONE) {
#ifndef FACET_NO_INSTANCES
      if (!is_inside) {
        place = FACET_LEAF_FIRST(node);
        node = enter_tree(s, place, o, d, world, &outer, space, &sides, waiting, &top);
        is_inside = node != FACET_NONE;
        if (is_inside) continue;
      } else
#endif
        if (meet_leaf(s, positions, space, place, outer, node, tmin, mode, q)) return;
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

#ifdef FACET_NO_INSTANCES

static inline uint next_waiting(const uint* waiting, int* top) {
  return *top == 0 ? FACET_NONE : waiting[--*top];
}

// Lanes of a warp that may go on without a leaf while the others wait with one.
#define FEW_LANES 4u

// Where t of the hit does not matter and nothing is culled by it, a leaf can wait: a work-item that has
// found one goes on until it has the next, and a warp until few of its lanes have none, so that leaves
// are tested by many lanes at once (speculative traversal: Aila and Laine, HPG 2009). Not among instances,
// where lanes would wait for others to enter one (a third slower).
static inline void search_any(const Scene* s, GEOMETRY positions, float tmin, uint mode, Space* space, Query* q) {
  uint waiting[FACET_STACK];
  int top = 0;
  uint node = s->root, leaf = FACET_NONE;  // that waits
  const Interval outer = {-INFINITY, INFINITY};
  const Sides sides = near_sides(space->slabs);
  do {
    while (!(node & FACET_LEAF_BIT)) {
      node = visit_node(s, node, space, sides, tmin, q->t, mode, waiting, 0, &top);
      if (node == FACET_NONE) node = next_waiting(waiting, &top);
      if (leaf == FACET_NONE && (node & FACET_LEAF_BIT)) {
        leaf = node;
        node = next_waiting(waiting, &top);
      }
#ifdef FACET_PTX
      if (active_lanes(leaf == FACET_NONE) <= FEW_LANES) break;
#endif
    }
    for (;;) {
      if (leaf == FACET_NONE && (node & FACET_LEAF_BIT)) {
        leaf = node;
        node = next_waiting(waiting, &top);
      }
      if (leaf == FACET_NONE) break;
      if (meet_leaf(s, positions, space, 0u, outer, leaf, tmin, mode, q)) return;
      leaf = FACET_NONE;
    }
  } while (node != FACET_NONE);
}

#endif

static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
#ifdef FACET_NO_INSTANCES
  if (mode != FACET_CLOSEST) {
    search_any(s, positions, tmin, mode, space, q);
    return;
  }
#endif
  search_in_order(s, positions, o, d, tmin, mode, space, q);
}

#endif
