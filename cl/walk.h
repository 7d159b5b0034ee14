// Single rays that go on from nodes of a tree by themselves, several of them in turns: while one works, what the others
// read next comes.
#ifndef FACET_WALK_H
#define FACET_WALK_H

#include "search_wide.h"
#include "stream.h"

// So many go in turns, and so many wait before they do. On a Xeon in turns of 4 and of 16 it was 2 to 4% slower, alone 8%.
#define WALKS 8u
#define WALKS_WAIT 32u

// Those that wait: rays, and the nodes to go on from.
typedef struct {
  uint node[WALKS_WAIT], ray[WALKS_WAIT];
  uint count, doubtful;  // doubtful: search_stream.h, meet_leaf
} Walkers;

typedef struct {
  ulong stack[FACET_STACK];  // search_wide.h: waiting
  __global StreamRay* ray;
  __global StreamRest* rest;
  uint node;
  int top;
} Walk;

// A node or a leaf further; false at the end.
static inline bool walk_on(const Scene* s, GEOMETRY positions, Walk* w, uint mode, Mask* doubtful) {
  __global StreamRay* r = w->ray;
  if (w->node & FACET_LEAF_BIT) {
    meet_block_alone(s, positions, FACET_LEAF_FIRST(w->node), r, w->rest, mode, doubtful);
  } else {
    __global const WideNode* n = s->nodes + w->node;
    Slabs slabs;
    slabs.inverse = vec_global(r->inverse);
    slabs.near_offset = vec_global(r->near_offset);
    slabs.far_offset = vec_global(r->far_offset);
    Each near, far;
    child_intervals(slabs, near_sides(slabs), n->x[0], r->tmin, r->t, &near, &far);
    const uint lanes = lanes_of(near <= far);
    if (lanes != 0u) {
      w->node = push_children(s, positions, n->child, lanes, near, w->stack, &w->top);
      if (without_first(lanes) == 0u) fetch_child(s, positions, w->node);
      return true;
    }
  }
  ulong entry;
  do {
    if (w->top == 0) return false;
    entry = w->stack[--w->top];
  } while (near_of(entry) > r->t);
  w->node = (uint)entry;
  fetch_child(s, positions, w->node);
  return true;
}

// Begins with the next that waits; false if there is none.
static inline bool begin_walk(__global Stream* x, const Walkers* all, uint* next, Walk* w) {
  if (*next == all->count) return false;
  const uint k = (*next)++, ray = all->ray[k];
  w->ray = &x->ray[ray];
  w->rest = &x->rest[ray];
  w->node = all->node[k];
  w->top = 0;
  return true;
}

// All that wait, to their ends.
APART void walk(const Scene* s, GEOMETRY positions, __global Stream* x, Walkers* all, uint mode) {
  Walk walks[WALKS];
  uint place[WALKS], going = 0u, next = 0u;
  Mask doubtful = (Mask)(0);
  while (going < WALKS && begin_walk(x, all, &next, &walks[going])) place[going] = going, ++going;
  while (going > 0u) {
    for (uint k = 0u; k < going;) {
      Walk* w = &walks[place[k]];
      if (walk_on(s, positions, w, mode, &doubtful) || begin_walk(x, all, &next, w))
        ++k;
      else
        place[k] = place[--going];
    }
  }
  all->count = 0u;
  all->doubtful |= lanes_of(doubtful);
}

static inline void add_walker(const Scene* s, GEOMETRY positions, __global Stream* x, Walkers* all, uint node, uint ray,
                              uint mode) {
  const uint k = all->count++;
  all->node[k] = node;
  all->ray[k] = ray;
  if (all->count == WALKS_WAIT) walk(s, positions, x, all, mode);
}

#endif
