// A tree over up to 32 boxes by the surface area heuristic (MacDonald and Booth 1990), by a group of 32
// work-items that splits a whole level at once. All splits between boxes are tried, along all axes.
//
// Each work-item holds the place of one box, and tries the splits where the boxes whose centres are not
// below its own go left. Boxes of one node are neighbours; a split puts those that go left
// before the others, each side in its old order.
//
// The tree depends on the boxes and their order alone: of equal centres the box that came first is the
// lower; of splits that cost the same the one with the lowest axis comes first, then the one with the
// fewest boxes on the left. cl/serial_sweep.h gets the same tree.
#ifndef FACET_SWEEP_H
#define FACET_SWEEP_H

#include "bounds.h"

#define SWEEP_MOST FACET_SWEEP_MOST

// Words of local memory, in the order in which they stand.
#define SWEEP_BOX 0u        // [6][32] floats
#define SWEEP_WEIGHT 192u   // what a box counts in the heuristic, a float; without it, 1
#define SWEEP_COST 224u     // the best split that a place has found: its cost, ...
#define SWEEP_KEY 256u      // ... axis and boxes on the left
#define SWEEP_MASK 288u     // places that ..., one word a purpose
#define SWEEP_NODES 292u    // [31][16]: finished nodes
// FACET_SWEEP_WORDS in all

#define NODE_CHILD 12u  // words of a Node before its children
#define NO_LINK 0xffffffffu

static inline Bounds sweep_box(__local const float* box, uint i) {
  Bounds b;
  b.lo = (float3)(box[i], box[32u + i], box[64u + i]);
  b.hi = (float3)(box[96u + i], box[128u + i], box[160u + i]);
  return b;
}

static inline void put_sweep_box(__local float* box, uint i, Bounds b) {
  box[i] = b.lo.x, box[32u + i] = b.lo.y, box[64u + i] = b.lo.z;
  box[96u + i] = b.hi.x, box[128u + i] = b.hi.y, box[160u + i] = b.hi.z;
}

static inline void put_child_bounds(__local uint* node, uint side, Bounds b) {
  node[side] = as_uint(b.lo.x), node[2u + side] = as_uint(b.hi.x);
  node[4u + side] = as_uint(b.lo.y), node[6u + side] = as_uint(b.hi.y);
  node[8u + side] = as_uint(b.lo.z), node[10u + side] = as_uint(b.hi.z);
}

#ifdef FACET_SWEEP_WEIGHTS
#define SWEEP_WEIGHT_OF(pool, i) as_float((pool)[SWEEP_WEIGHT + (i)])
#else
#define SWEEP_WEIGHT_OF(pool, i) 1.0f
#endif

static inline Bounds child_bounds(__local const uint* node, uint side) {
  Bounds b;
  b.lo = (float3)(as_float(node[side]), as_float(node[4u + side]), as_float(node[8u + side]));
  b.hi = (float3)(as_float(node[2u + side]), as_float(node[6u + side]), as_float(node[10u + side]));
  return b;
}

// The two sides of a split.
typedef struct {
  Bounds left, right;
  float left_weight, right_weight;
  uint left_count;
} TwoSides;

static inline TwoSides no_sides(void) {
  TwoSides s;
  s.left = s.right = no_bounds();
  s.left_weight = s.right_weight = 0.0f;
  s.left_count = 0u;
  return s;
}

static inline void take_side(TwoSides* s, bool is_left, Bounds b, float weight) {
  if (is_left) {
    s->left = joined(s->left, b);
    s->left_weight += weight;
    ++s->left_count;
  } else {
    s->right = joined(s->right, b);
    s->right_weight += weight;
  }
}

// Whether of two centres along an axis place i's is below place `own`'s.
static inline bool is_below(float at_i, uint i, float at_own, uint own) {
  return at_i < at_own || (at_i == at_own && i < own);
}

static inline float axis_centre2(__local const float* box, uint i, uint axis) {
  return box[axis * 32u + i] + box[(axis + 3u) * 32u + i];
}

// The sides of the split of places begin .. end - 1 below place `own` along an axis.
static inline TwoSides sides_below(__local const uint* pool, uint begin, uint end, uint own, uint axis) {
  __local const float* box = (__local const float*)pool;
  TwoSides s = no_sides();
  const float here = axis_centre2(box, own, axis);
  for (uint i = begin; i < end; ++i)
    take_side(&s, is_below(axis_centre2(box, i, axis), i, here, own), sweep_box(box, i), SWEEP_WEIGHT_OF(pool, i));
  return s;
}

// What a split below a place costs, and its key: the axis and below it how many boxes are on the left.
typedef struct {
  float cost;
  uint key;
} Split;

static inline void better_split(Split* best, uint axis, const TwoSides* sides) {
  const float cost = split_cost(sides->left, tests_of(sides->left_weight), sides->right, tests_of(sides->right_weight));
  const uint key = axis << 8 | sides->left_count;
  if (sides->left_count == 0u || cost > best->cost || (cost == best->cost && key > best->key)) return;
  best->cost = cost;
  best->key = key;
}

// The best of the splits of places begin .. end - 1 below place `own`, of all axes in one pass.
static inline Split best_split_below(__local const uint* pool, uint begin, uint end, uint own) {
  __local const float* box = (__local const float*)pool;
  const float3 here = centre2(sweep_box(box, own));
  TwoSides x = no_sides(), y = no_sides(), z = no_sides();
  for (uint i = begin; i < end; ++i) {
    const Bounds b = sweep_box(box, i);
    const float3 c = centre2(b);
    const float weight = SWEEP_WEIGHT_OF(pool, i);
    take_side(&x, is_below(c.x, i, here.x, own), b, weight);
    take_side(&y, is_below(c.y, i, here.y, own), b, weight);
    take_side(&z, is_below(c.z, i, here.z, own), b, weight);
  }
  Split best;
  best.cost = INFINITY;
  best.key = 0xffffffffu;
  better_split(&best, 0u, &x);
  better_split(&best, 1u, &y);
  better_split(&best, 2u, &z);
  return best;
}

// What a place knows of the tree once it is finished.
typedef struct {
  uint leaf_begin, leaf_count;  // of its leaf; `link` says which child that is
  uint link;                    // 2 * node + side, or NO_LINK: the root is a leaf
  uint depth;                   // nodes above the leaf
  uint moved_from;              // where its box stood before
  uint nodes;                   // of the whole tree
} Swept;

// All work-items call this together; boxes and weights are those of places 0 .. count - 1. Nodes, the root first,
// have children that are numbered from `base` on where they are nodes; leaves are left for the caller.
static inline Swept sweep_tree(uint lane, uint count, uint base, __local uint* pool) {
  __local float* box = (__local float*)pool;
  const uint below = (1u << lane) - 1u;
  Swept t;
  t.nodes = 0u;
  t.link = NO_LINK;
  t.depth = 0u;
  t.moved_from = lane;
  uint begin = 0u, end = count;
  bool is_open = lane < count;
  // Of the node that the place is in.
  Bounds all = no_bounds();
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0u; i < count; ++i) all = joined(all, sweep_box(box, i));
  for (uint level = 0u; level < SWEEP_MOST; ++level) {
    barrier(CLK_LOCAL_MEM_FENCE);
    if (lane < 2u) pool[SWEEP_MASK + lane] = 0u;
    is_open = is_open && end - begin > LEAF_SURE;
    Split own;
    own.cost = INFINITY;
    own.key = 0xffffffffu;
    if (is_open) own = best_split_below(pool, begin, end, lane);
    pool[SWEEP_COST + lane] = as_uint(own.cost);
    pool[SWEEP_KEY + lane] = own.key;
    barrier(CLK_LOCAL_MEM_FENCE);

    uint winner = begin;
    if (is_open) {
      for (uint i = begin + 1u; i < end; ++i) {
        const float a = as_float(pool[SWEEP_COST + i]), b = as_float(pool[SWEEP_COST + winner]);
        if (a < b || (a == b && pool[SWEEP_KEY + i] < pool[SWEEP_KEY + winner])) winner = i;
      }
      if (end - begin <= LEAF_MOST)
        is_open = half_area(all) * (float)(end - begin - 1u) > as_float(pool[SWEEP_COST + winner]);
    }
    const uint key = pool[SWEEP_KEY + winner], axis = is_open ? key >> 8 : 0u, left_count = key & 255u;
    const bool goes_left = is_open && is_below(axis_centre2(box, lane, axis), lane,
                                               axis_centre2(box, winner, axis), winner);
    if (is_open && lane == begin) atomic_or(&pool[SWEEP_MASK], 1u << lane);
    if (goes_left) atomic_or(&pool[SWEEP_MASK + 1u], 1u << lane);
    barrier(CLK_LOCAL_MEM_FENCE);

    const uint split = pool[SWEEP_MASK], lefts = pool[SWEEP_MASK + 1u];
    if (split == 0u) break;
    uint to = lane;
    const Bounds moved = sweep_box(box, lane);
    const uint weight = pool[SWEEP_WEIGHT + lane];
    if (is_open) {
      const uint node = t.nodes + popcount(split & ((1u << begin) - 1u));
      if (lane == winner) {
        const TwoSides sides = sides_below(pool, begin, end, lane, axis);
        put_child_bounds(pool + SWEEP_NODES + 16u * node, 0u, sides.left);
        put_child_bounds(pool + SWEEP_NODES + 16u * node, 1u, sides.right);
      }
      if (lane == begin && t.link != NO_LINK)
        pool[SWEEP_NODES + 16u * (t.link >> 1) + NODE_CHILD + (t.link & 1u)] = base + node;
      const uint before = below & ~((1u << begin) - 1u);
      to = goes_left ? begin + popcount(lefts & before) : begin + left_count + popcount(~lefts & before);
      const bool is_right = lane >= begin + left_count;
      if (is_right) begin += left_count;
      else end = begin + left_count;
      t.link = 2u * node + (is_right ? 1u : 0u);
      ++t.depth;
    }
    t.nodes += popcount(split);
    pool[SWEEP_COST + to] = t.moved_from;
    barrier(CLK_LOCAL_MEM_FENCE);
    put_sweep_box(box, to, moved);
    pool[SWEEP_WEIGHT + to] = weight;
    t.moved_from = pool[SWEEP_COST + lane];
    if (is_open) all = child_bounds(pool + SWEEP_NODES + 16u * (t.link >> 1), t.link & 1u);
  }
  t.leaf_begin = begin;
  t.leaf_count = end - begin;
  return t;
}

#endif
