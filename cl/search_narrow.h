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

// A search under way, which goes on by steps until `node` is FACET_NONE. Beside it goes what waits.
typedef struct {
  uint node;
  int top;    // how many wait
  uint leaf;  // step_any: that waits apart, or FACET_NONE
  Sides sides;
  Interval outer;  // of the box of the instance at `place`, in whose tree it is
  uint place;
#ifdef FACET_NO_INSTANCES
  Parts parts;
#else
  bool is_inside;
  Slabs world;
#endif
} Walk;

static inline void begin_walk(const Scene* s, const Space* space, Walk* w) {
  w->node = s->root;
  w->top = 0;
  w->leaf = FACET_NONE;
  w->sides = near_sides(space->slabs);
  w->outer.near = -INFINITY, w->outer.far = INFINITY;
  w->place = 0u;
#ifdef FACET_NO_INSTANCES
  w->parts = parts_of(space->slabs);
#else
  w->is_inside = false;
  w->world = space->slabs;
#endif
}

// To the nearer of a node's children that are to be visited, while the other one waits; to FACET_NONE if none is.
static inline void visit_node(const Scene* s, const Space* space, float tmin, float best, uint mode, Walk* w,
                              uint* waiting, float* near_of) {
  __global const Node* n = s->nodes + w->node;
  const uint4 child = *(__global const uint4*)n->child;
  Each near, far;
#ifdef FACET_NO_INSTANCES
  // Among instances there are not the registers for it.
  if (mode != FACET_ANY)
    child_intervals_by_parts(space->slabs, w->parts, n->x[0], tmin, best, &near, &far);
  else
#endif
    child_intervals(space->slabs, w->sides, n->x[0], tmin, best, &near, &far);
  const bool is_first = near.x <= far.x, is_second = near.y <= far.y;
  const bool is_swapped = is_first && is_second ? near.y < near.x : is_second;
  if (is_first && is_second) {
    if (mode == FACET_CLOSEST) near_of[w->top] = is_swapped ? near.x : near.y;
    waiting[w->top++] = is_swapped ? child.x : child.y;
  }
  w->node = !is_first && !is_second ? FACET_NONE : is_swapped ? child.y : child.x;
}

// True if the query is answered.
static inline bool meet_leaf(const Scene* s, GEOMETRY positions, Space* space, const Walk* w, uint leaf, float tmin,
                             uint mode, Query* q) {
  const uint slot = FACET_LEAF_FIRST(leaf), count = FACET_LEAF_COUNT(leaf);
#ifdef FACET_NO_INSTANCES
  // So that no register holds it on the way down: triangles hardly ever need it.
  if (mode != FACET_ANY) space->slabs.inverse = w->parts.above + w->parts.below;
#endif
  for (uint k = 0; k < count; ++k)
    if (meet_triangles(s, positions, space, w->place, w->outer, slot + k, tmin, mode, q)) return true;
  return false;
}

#ifndef FACET_NO_INSTANCES

// To the root of an instance's tree, once the ray is taken into it and the stack marked; false if the ray cannot
// meet it.
static inline bool enter_tree(const Scene* s, float3 o, float3 d, Space* space, Walk* w, uint* waiting) {
  w->place = FACET_LEAF_FIRST(w->node);
  w->is_inside = enter_instance(s, w->place, o, d, w->world, &w->outer, space);
  if (!w->is_inside) return false;
  w->sides = near_sides(space->slabs);
  waiting[w->top++] = FACET_INSTANCE_ENDS;
  w->node = s->instances[w->place].root;
  return true;
}

static inline void leave_tree(Space* space, Walk* w) {
  w->is_inside = false;
  space->slabs = w->world;
  w->sides = near_sides(w->world);
}

#endif

// Down to a leaf, the nearer child first, and back to what waits.
static inline void step_in_order(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                                 Space* space, Query* q, Walk* w, uint* waiting, float* near_of) {
  while (!(w->node & FACET_LEAF_BIT)) visit_node(s, space, tmin, q->t, mode, w, waiting, near_of);
  if (w->node != FACET_NONE) {
#ifndef FACET_NO_INSTANCES
    if (!w->is_inside) {
      if (enter_tree(s, o, d, space, w, waiting)) return;
    } else
#endif
      if (meet_leaf(s, positions, space, w, w->node, tmin, mode, q))
      w->top = 0;
  }
  for (;;) {
    w->node = FACET_NONE;
    if (w->top == 0) return;
    w->node = waiting[--w->top];
#ifndef FACET_NO_INSTANCES
    if (w->node == FACET_INSTANCE_ENDS) {
      leave_tree(space, w);
      continue;
    }
#endif
    if (mode != FACET_CLOSEST || near_of[w->top] <= q->t) return;
  }
}

#ifdef FACET_NO_INSTANCES

static inline uint next_waiting(const uint* waiting, int* top) {
  return *top == 0 ? FACET_NONE : waiting[--*top];
}

// The leaf that is met waits apart, if none does.
static inline void put_apart(Walk* w, const uint* waiting) {
  if (w->leaf != FACET_NONE || !(w->node & FACET_LEAF_BIT)) return;
  w->leaf = w->node;
  w->node = next_waiting(waiting, &w->top);
}

// Lanes of a warp that may go on without a leaf while the others wait with one.
#define FEW_LANES 4u

// For any hit, whose t does not matter and culls nothing, a leaf can wait: a work-item that has
// found one goes on until it has the next, and a warp until few of its lanes have none, so that leaves
// are tested by many lanes at once (speculative traversal: Aila and Laine, HPG 2009). Not among instances,
// where lanes would wait for others to enter one (a third slower), nor for crossings (pictures 11 to 15% slower).
static inline void step_any(const Scene* s, GEOMETRY positions, float tmin, Space* space, Query* q, Walk* w,
                            uint* waiting) {
  while (!(w->node & FACET_LEAF_BIT)) {
    visit_node(s, space, tmin, q->t, FACET_ANY, w, waiting, 0);
    if (w->node == FACET_NONE) w->node = next_waiting(waiting, &w->top);
    put_apart(w, waiting);
#ifdef FACET_PTX
    if (active_lanes(w->leaf == FACET_NONE) <= FEW_LANES) break;
#endif
  }
  for (;;) {
    put_apart(w, waiting);
    if (w->leaf == FACET_NONE) return;
    const bool is_answered = meet_leaf(s, positions, space, w, w->leaf, tmin, FACET_ANY, q);
    w->leaf = FACET_NONE;
    if (!is_answered) continue;
    w->node = FACET_NONE;
    return;
  }
}

#endif

// Where t of the hit does not matter `near_of` is not used.
static inline void step(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                        Space* space, Query* q, Walk* w, uint* waiting, float* near_of) {
#ifdef FACET_NO_INSTANCES
  if (mode == FACET_ANY) {
    step_any(s, positions, tmin, space, q, w, waiting);
    return;
  }
#endif
  step_in_order(s, positions, o, d, tmin, mode, space, q, w, waiting, near_of);
}

static inline void search(const Scene* s, GEOMETRY positions, float3 o, float3 d, float tmin, uint mode,
                          Space* space, Query* q) {
  uint waiting[FACET_STACK];
  float near_of[FACET_STACK];
  Walk w;
  begin_walk(s, space, &w);
  do step(s, positions, o, d, tmin, mode, space, q, &w, waiting, near_of);
  while (w.node != FACET_NONE);
}

#endif
