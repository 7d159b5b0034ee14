// A search through trees of eight children a node for a stream of rays at once: a node is read once for all rays that
// meet its box, which then part into lists, one for each child (after Tsakok, "Faster incoherent rays: multi-BVH ray
// stream tracing", 2009). What a ray visits it visits by its own intervals, so that its hit is the same (box.h); which
// child comes first is the list's choice, and a ray visits some more than by itself.
//
// A ray by itself waits for each of its comparisons before it knows what to read; of a list's rays none waits for
// another.
#ifndef FACET_SEARCH_STREAM_H
#define FACET_SEARCH_STREAM_H

#include "walk.h"

// A list that waits for a node.
typedef struct {
  uint node, begin, count;
} Waiting;

typedef struct {
  Waiting list[FACET_STACK + 8u];
  int top;
} Lists;

// A node's sides, those first that rays of one kind meet first.
typedef struct {
  Each nx, ny, nz, fx, fy, fz;
} NodeSides;

static inline NodeSides sides_of(__global const float* faces, Sides near_at) {
  NodeSides n;
  read_sides(faces, near_at.x, &n.nx, &n.fx);
  read_sides(faces + 2u * FACET_SIDE, near_at.y, &n.ny, &n.fy);
  read_sides(faces + 4u * FACET_SIDE, near_at.z, &n.nz, &n.fz);
  return n;
}

// As child_intervals.
static inline void child_intervals_of(const NodeSides* n, __global const StreamRay* r, Each* near, Each* far) {
  const float x = r->inverse[0], y = r->inverse[1], z = r->inverse[2];
  common_interval(crossed_at(n->nx, x, r->near_offset[0]), crossed_at(n->ny, y, r->near_offset[1]),
                  crossed_at(n->nz, z, r->near_offset[2]), crossed_at(n->fx, x, r->far_offset[0]),
                  crossed_at(n->fy, y, r->far_offset[1]), crossed_at(n->fz, z, r->far_offset[2]), r->tmin, r->t, near,
                  far);
}

// Finds which children the rays of a list meet: how many meet each, and where the last one of them does.
static inline int8 part_list(__global const float* faces, Sides near_at, __global Stream* x, uint begin, uint count,
                             Each* at) {
  const NodeSides sides = sides_of(faces, near_at);
  int8 counts = (int8)(0);
  *at = (Each)(0.0f);
  for (uint i = 0u; i < count; ++i) {
    const uint ray = x->list[begin + i];
    Each near, far;
    child_intervals_of(&sides, &x->ray[ray], &near, &far);
    const int8 meets = near <= far;
    counts -= meets;
    *at = meets ? near : *at;
    x->parted[i] = ray;
    x->meets[i] = lanes_of(meets);
  }
  return counts;
}

// In the order in which children are put on the stack, the farthest first and those without rays last: the place of
// each in it, and where its list begins. By comparing all with all, for a branch on what a ray meets costs more.
#define BEHIND(j) is_behind = (int8)(key.s##j) > key, *place -= is_behind, *first += is_behind & (int8)(counts.s##j)
static inline void order_lists(int8 counts, Each at, uint begin, int8* place, int8* first) {
  const int8 lane = (int8)(0, 1, 2, 3, 4, 5, 6, 7);
  // Distances are at least 0 and order as integers; their last bits make way for what makes each its own.
  const int8 key = counts != 0 ? (as_int8(at) & 0x7ffffff8) | lane : lane - 8;
  int8 is_behind;
  *place = (int8)(0);
  *first = (int8)((int)begin);
  BEHIND(0), BEHIND(1), BEHIND(2), BEHIND(3), BEHIND(4), BEHIND(5), BEHIND(6), BEHIND(7);
}
#undef BEHIND

// Puts a ray on the list of its first child but those that went before, if there is one: without a branch, for one
// that is 8 stands for none, and nothing keeps what is written there.
static inline uint put_on_list(__global Stream* x, uint lanes, uint ray, uint* end) {
  const uint child = first_lane(lanes | 1u << FACET_LANES), to = end[child];
  end[child] = to + (child < FACET_LANES ? 1u : 0u);
  x->list[to] = ray;
  return without_first(lanes | 1u << FACET_LANES) & ((1u << FACET_LANES) - 1u);
}

static inline int sum_of(int8 a) {
  const int4 b = a.lo + a.hi;
  const int2 c = b.lo + b.hi;
  return c.x + c.y;
}

// The rays of the last list go on into the node's children.
static inline void enter_node(const Scene* s, GEOMETRY positions, __global Stream* x, Lists* l, uint node, uint begin,
                              uint count, Sides near_at, Walkers* alone, uint mode) {
  __global const WideNode* n = s->nodes + node;
  Each at;
  const int8 counts = part_list(n->x[0], near_at, x, begin, count, &at);
  uint lanes = lanes_of(counts != 0);
  if (begin + (uint)sum_of(counts) > FACET_LISTS) {
    for (uint i = 0u; i < count; ++i) add_walker(s, positions, x, alone, node, x->parted[i], mode);
    return;
  }
  int8 place, first;
  order_lists(counts, at, begin, &place, &first);
  int places[FACET_LANES], each[FACET_LANES];
  uint end[FACET_LANES + 1u];
  vstore8(place, 0, places);
  vstore8(counts, 0, each);
  vstore8(as_uint8(first), 0, end);
  end[FACET_LANES] = FACET_LISTS;
  for (uint c = 0u; c < FACET_LANES; ++c) {
    Waiting* w = &l->list[l->top + places[c]];
    w->node = n->child[c];
    w->begin = end[c];
    w->count = (uint)each[c];
  }
  l->top += popcount(lanes);
  for (; lanes != 0u; lanes = without_first(lanes)) fetch_child(s, positions, n->child[first_lane(lanes)]);
  // Few rays meet more than two children.
  for (uint i = 0u; i < count; ++i) {
    const uint ray = x->parted[i];
    uint left = put_on_list(x, x->meets[i], ray, end);
    left = put_on_list(x, left, ray, end);
    while (left != 0u) left = put_on_list(x, left, ray, end);
  }
}

// Gives the lanes of which some ray's are doubtful (stream.h).
APART uint meet_leaf(const Scene* s, GEOMETRY positions, __global Stream* x, uint block, uint begin, uint count,
                     uint mode) {
  Mask doubtful = (Mask)(0);
  for (uint i = begin; i < begin + count; ++i) {
    const uint ray = x->list[i];
    if (mode == FACET_ANY && x->ray[ray].slot != FACET_NONE) continue;
    meet_block_alone(s, positions, block, &x->ray[ray], &x->rest[ray], mode, &doubtful);
  }
  return lanes_of(doubtful);
}

// Depth first: so the lists that wait lie in memory as their children's do on the stack, and a list's place is free
// when it is parted. Rays of the first list start at the root; they are of one kind.
//
// A node leaves at most seven lists waiting: FACET_STACK is enough, as it is for search_wide.h, and eight places more
// for children without rays.
//
// As meet_leaf.
APART uint search_list(const Scene* s, GEOMETRY positions, __global Stream* x, uint count, Sides near_at, uint mode) {
  Lists lists;
  Walkers alone;
  alone.count = alone.doubtful = 0u;
  lists.top = 0;
  uint node = s->root, begin = 0u;
  for (;;) {
    if (count == 1u)
      add_walker(s, positions, x, &alone, node, x->list[begin], mode);
    else if (node & FACET_LEAF_BIT)
      alone.doubtful |= meet_leaf(s, positions, x, FACET_LEAF_FIRST(node), begin, count, mode);
    else
      enter_node(s, positions, x, &lists, node, begin, count, near_at, &alone, mode);
    if (lists.top == 0) break;
    const Waiting w = lists.list[--lists.top];
    node = w.node, begin = w.begin, count = w.count;
  }
  walk(s, positions, x, &alone, mode);
  return alone.doubtful;
}

// All `count` rays of a stream, kind by kind: those of one meet the same sides of boxes first. False if there is any
// doubt about what they have met, which hardly ever is.
static inline bool search_stream(const Scene* s, GEOMETRY positions, __global Stream* x, uint count, uint mode) {
  uint of_kind[8] = {0u}, end[8], sum = 0u;
  for (uint i = 0u; i < count; ++i) ++of_kind[x->kind[i]];
  for (uint kind = 0u; kind < 8u; ++kind) end[kind] = sum, sum += of_kind[kind];
  uint doubtful = 0u;
  for (uint i = 0u; i < count; ++i) x->order[end[x->kind[i]]++] = i;
  for (uint kind = 0u; kind < 8u; ++kind) {
    const uint alike = of_kind[kind], first = end[kind] - alike;
    if (alike == 0u) continue;
    for (uint i = 0u; i < alike; ++i) x->list[i] = x->order[first + i];
    const Sides near_at = {kind & 1u ? FACET_SIDE : 0u, kind & 2u ? FACET_SIDE : 0u, kind & 4u ? FACET_SIDE : 0u};
    doubtful |= search_list(s, positions, x, alike, near_at, mode);
  }
  return doubtful == 0u;
}

#endif
