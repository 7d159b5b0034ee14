// What cl/sweep.h does with a group of work-items, done by one alone: a tree over up to 32 boxes, by the
// surface area heuristic over all splits of all axes. The same boxes give the same tree: costs, ties and
// the order of choices are those of sweep.h.
#ifndef FACET_SERIAL_SWEEP_H
#define FACET_SERIAL_SWEEP_H

#include "packed.h"

#define SWEEP_MOST FACET_SWEEP_MOST

// Up to 32 boxes: by place, in the order in which they came.
typedef struct {
  Packed box[32];
  float centre[3][32];  // doubled
  uint tie[32];
  uint weight[32];
} Entries;

// Indices of entries: by each axis' centres, and by ties.
typedef struct {
  uchar by[4][32];
} Orders;

static inline void put_entry(Entries* e, uint i, Bounds b, uint tie, uint weight) {
  const float3 c = centre2(b);
  e->box[i] = packed(b);
  e->centre[0][i] = c.x, e->centre[1][i] = c.y, e->centre[2][i] = c.z;
  e->tie[i] = tie;
  e->weight[i] = weight;
}

static inline void order_by_ties(const Entries* e, uint count, Orders* o) {
  for (uint i = 0u; i < count; ++i) {
    uint k = i;
    for (; k > 0u && e->tie[o->by[3][k - 1u]] > e->tie[i]; --k) o->by[3][k] = o->by[3][k - 1u];
    o->by[3][k] = (uchar)i;
  }
}

// Equal centres keep the order of ties.
static inline void order_by_axis(const Entries* e, uint count, uint axis, Orders* o) {
  const float* c = e->centre[axis];
  uchar* by = o->by[axis];
  for (uint n = 0u; n < count; ++n) {
    const uchar i = o->by[3][n];
    const float at = c[i];
    uint k = n;
    for (; k > 0u && c[by[k - 1u]] > at; --k) by[k] = by[k - 1u];
    by[k] = i;
  }
}

typedef struct {
  float cost;
  uint axis, left;
  Packed left_box, right_box;
} SerialSplit;

// When a subtree becomes a leaf (bounds.h: LEAF_SURE, LEAF_MOST, and of LEAF_BLOCK the bit): known when it is built, so
// that one program has trees of any rule.
typedef struct {
  uint sure, most, block_bit;
} LeafRule;

// As tests_of (bounds.h), of integers: PoCL makes a call of ceil.
static inline float rounded_tests(uint weight, uint block_bit) {
  return (float)(int)((weight + (1u << block_bit) - 1u) >> block_bit);
}

static inline SerialSplit best_serial_split(const Entries* e, const Orders* o, uint begin, uint end,
                                            uint block_bit) {
  SerialSplit best;
  best.cost = INFINITY;
  best.axis = FACET_NONE;
  best.left = 1u;
  best.left_box = best.right_box = no_packed();
  for (uint axis = 0u; axis < 3u; ++axis) {
    const uchar* by = o->by[axis];
    Packed right[32];
    uint right_weight[32];
    Packed box = no_packed();
    uint weight = 0u;
    for (uint i = end - 1u; i > begin; --i) {
      box = joined_packed(e->box[by[i]], box);
      weight += e->weight[by[i]];
      right[i - begin] = box;
      right_weight[i - begin] = weight;
    }
    box = no_packed();
    weight = 0u;
    for (uint i = begin + 1u; i < end; ++i) {
      box = joined_packed(e->box[by[i - 1u]], box);
      weight += e->weight[by[i - 1u]];
      const float cost =
          packed_cost(box, rounded_tests(weight, block_bit), right[i - begin],
                      rounded_tests(right_weight[i - begin], block_bit));
      if (cost < best.cost || best.axis == FACET_NONE) {
        best.cost = cost;
        best.axis = axis;
        best.left = i - begin;
        best.left_box = box;
        best.right_box = right[i - begin];
      }
    }
  }
  return best;
}

static inline void part_orders(Orders* o, uint begin, uint end, uint axis, uint left) {
  uint lefts = 0u;
  for (uint i = begin; i < begin + left; ++i) lefts |= 1u << o->by[axis][i];
  for (uint k = 0u; k < 4u; ++k) {
    uchar kept[32];
    uint l = begin, r = 0u;
    for (uint i = begin; i < end; ++i) {
      const uchar at = o->by[k][i];
      const uint is_left = lefts >> at & 1u;
      o->by[k][l] = at;
      kept[r] = at;
      l += is_left;
      r += 1u - is_left;
    }
    for (uint i = 0u; i < r; ++i) o->by[k][l + i] = kept[i];
  }
}

typedef struct {
  uint begin, end, link, depth;
  Packed box;
} Segment;

// The tree over entries 0 .. count - 1, its nodes numbered from `base` on; leaf i (in order) is leaves[i]: begin, end
// in orders.by[3], and its link and depth. Returns the nodes; *leaf_count.
APART uint serial_sweep(const Entries* e, uint count, LeafRule rule, uint base, Node* nodes, Orders* orders,
                        Segment* leaves, uint* leaf_count) {
  order_by_ties(e, count, orders);
  for (uint axis = 0u; axis < 3u && count > rule.sure; ++axis) order_by_axis(e, count, axis, orders);
  Segment stack[32];
  uint top = 0u, made = 0u, found = 0u;
  stack[top].box = e->box[0];
  for (uint i = 1u; i < count; ++i) stack[top].box = joined_packed(e->box[i], stack[top].box);
  stack[top].begin = 0u, stack[top].end = count, stack[top].link = FACET_NONE, stack[top].depth = 0u;
  ++top;
  while (top > 0u) {
    const Segment s = stack[--top];
    const uint size = s.end - s.begin;
    bool is_leaf = size <= rule.sure;
    SerialSplit split;
    if (!is_leaf) {
      split = best_serial_split(e, orders, s.begin, s.end, rule.block_bit);
      if (size <= rule.most)
        is_leaf = !(packed_area(s.box) * (float)(size - 1u) > split.cost);
    }
    if (is_leaf) {
      leaves[found++] = s;
      continue;
    }
    const uint at = made++;
    Node n;
    put_packed(&n, 0u, split.left_box);
    put_packed(&n, 1u, split.right_box);
    n.child[0] = n.child[1] = FACET_NONE;
    n.spare[0] = n.spare[1] = 0u;
    nodes[at] = n;
    if (s.link != FACET_NONE) nodes[s.link >> 1].child[s.link & 1u] = base + at;
    part_orders(orders, s.begin, s.end, split.axis, split.left);
    Segment c;
    c.depth = s.depth + 1u;
    c.begin = s.begin + split.left, c.end = s.end, c.link = 2u * at + 1u, c.box = split.right_box;
    stack[top++] = c;
    c.begin = s.begin, c.end = s.begin + split.left, c.link = 2u * at, c.box = split.left_box;
    stack[top++] = c;
  }
  *leaf_count = found;
  return made;
}

#endif
