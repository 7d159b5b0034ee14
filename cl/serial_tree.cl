// The trees of cl/bottom.cl and cl/top.cl, a work-item to each: for devices whose work-items are the
// cores of a CPU. The same boxes give the same tree: all costs, ties and bins are those of sweep.h and
// bins.h.
#include "bins.h"

#define SWEEP_MOST 32u
#ifndef LEAF_SURE
#define LEAF_SURE 8u
#endif
#ifndef LEAF_MOST
#define LEAF_MOST 8u
#endif

// A box that one comparison joins: lo, then -hi; the fourth of each is 0.
typedef float8 Packed;
static inline Packed packed(Bounds b) { return (Packed)(b.lo, 0.0f, -b.hi, 0.0f); }
static inline Packed no_packed(void) { return (Packed)(INFINITY); }
static inline Packed joined_packed(Packed a, Packed b) { return a < b ? a : b; }
static inline float packed_area(Packed b) {
  const float4 e = -b.hi - b.lo;
  return (e.x * e.y + e.y * e.z) + e.z * e.x;
}
static inline float packed_cost(Packed left, float left_weight, Packed right, float right_weight) {
  const float cost = packed_area(left) * left_weight + packed_area(right) * right_weight;
  return cost < INFINITY ? cost : INFINITY;
}

static inline void put_packed(Node* n, uint side, Packed b) {
  n->x[0][side] = b.s0, n->y[0][side] = b.s1, n->z[0][side] = b.s2;
  n->x[1][side] = -b.s4, n->y[1][side] = -b.s5, n->z[1][side] = -b.s6;
}

// Up to 32 boxes: by place, in the order in which they came.
typedef struct {
  Packed box[32];
  float centre[3][32];  // doubled
  uint tie[32];
  float weight[32];
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
  e->weight[i] = (float)weight;
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

static inline SerialSplit best_serial_split(const Entries* e, const Orders* o, uint begin, uint end) {
  SerialSplit best;
  best.cost = INFINITY;
  best.axis = FACET_NONE;
  best.left = 1u;
  best.left_box = best.right_box = no_packed();
  for (uint axis = 0u; axis < 3u; ++axis) {
    const uchar* by = o->by[axis];
    Packed right[32];
    float right_weight[32];
    Packed box = no_packed();
    float weight = 0.0f;
    for (uint i = end - 1u; i > begin; --i) {
      box = joined_packed(e->box[by[i]], box);
      weight += e->weight[by[i]];
      right[i - begin] = box;
      right_weight[i - begin] = weight;
    }
    box = no_packed();
    weight = 0.0f;
    for (uint i = begin + 1u; i < end; ++i) {
      box = joined_packed(e->box[by[i - 1u]], box);
      weight += e->weight[by[i - 1u]];
      const float cost = packed_cost(box, weight, right[i - begin], right_weight[i - begin]);
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

// The tree over entries 0 .. count - 1, its nodes numbered from `base` on; leaf i (in order) is leaves[i]: begin, end in orders.by[3], and its link and depth. Returns the nodes; *leaf_count.
static inline uint serial_sweep(const Entries* e, uint count, uint leaf_sure, uint leaf_most, uint base,
                                Node* nodes, Orders* orders, Segment* leaves, uint* leaf_count) {
  order_by_ties(e, count, orders);
  for (uint axis = 0u; axis < 3u && count > leaf_sure; ++axis) order_by_axis(e, count, axis, orders);
  Segment stack[32];
  uint top = 0u, made = 0u, found = 0u;
  stack[top].box = e->box[0];
  for (uint i = 1u; i < count; ++i) stack[top].box = joined_packed(e->box[i], stack[top].box);
  stack[top].begin = 0u, stack[top].end = count, stack[top].link = FACET_NONE, stack[top].depth = 0u;
  ++top;
  while (top > 0u) {
    const Segment s = stack[--top];
    const uint size = s.end - s.begin;
    bool is_leaf = size <= leaf_sure;
    SerialSplit split;
    if (!is_leaf) {
      split = best_serial_split(e, orders, s.begin, s.end);
      if (size <= leaf_most)
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

// As build_bottoms of cl/bottom.cl, `each` subtrees a work-item.
__kernel void build_bottoms(PRIMITIVES restrict primitives, __global const uint* starts, __global uint* order,
                            __global Node* nodes, __global Item* items, __global uint* refs,
                            __global uint* counter, uint room, uint subtrees, uint each) {
  const uint begin = (uint)get_global_id(0) * each, end = min(begin + each, subtrees);
  for (uint k = begin; k < end; ++k) {
    const uint first = starts[k], count = starts[k + 1u] - first;
    Entries e;
    uint primitive[32];
    Packed all = no_packed();
    for (uint i = 0u; i < count; ++i) {
      primitive[i] = order[first + i];
      put_entry(&e, i, bounds_at(primitives, primitive[i]), i, 1u);
      all = joined_packed(e.box[i], all);
    }
    Node made[31];
    Orders orders;
    Segment leaves[32];
    uint leaf_count, height = 0u;
    const uint made_count = serial_sweep(&e, count, LEAF_SURE, LEAF_MOST, 0u, made, &orders, leaves, &leaf_count);
    // What does not fit is counted all the same: the host makes room and starts again.
    const uint base = made_count == 0u ? 0u : atomic_add((volatile __global uint*)counter, made_count);
    for (uint i = 0u; i < made_count; ++i)
      for (uint side = 0u; side < 2u; ++side) made[i].child[side] += base;
    for (uint i = 0u; i < leaf_count; ++i) {
      const Segment l = leaves[i];
      if (l.link != FACET_NONE)
        made[l.link >> 1].child[l.link & 1u] = FACET_LEAF(first + l.begin, l.end - l.begin);
      height = max(height, l.depth);
    }
    if (base + made_count <= room)
      for (uint i = 0u; i < made_count; ++i) nodes[base + i] = made[i];
    for (uint i = 0u; i < count; ++i) order[first + i] = primitive[orders.by[3][i]];
    Item item;
    item.lo[0] = all.s0, item.lo[1] = all.s1, item.lo[2] = all.s2, item.index = k;
    item.hi[0] = -all.s4, item.hi[1] = -all.s5, item.hi[2] = -all.s6;
    item.size = count | height << FACET_HEIGHT_BIT;
    items[k] = item;
    refs[k] = made_count == 0u ? FACET_LEAF(first, count) : base;
  }
}

// A range of items that waits to be split.
typedef struct {
  uint begin, end, node, depth;
  float lo[3], hi[3];  // where bins lie for doubled centres
  uint first, last;    // between these are its items' indices
} Waiting;

typedef struct {
  Packed box[3][BINS];
  uint weight[3][BINS], items[3][BINS];
} Bins;

static inline void serial_bins(__global const Item* items, const Waiting* w, Bins* bins) {
  for (uint axis = 0u; axis < 3u; ++axis)
    for (uint k = 0u; k < BINS; ++k) {
      bins->box[axis][k] = no_packed();
      bins->weight[axis][k] = bins->items[axis][k] = 0u;
    }
  for (uint i = w->begin; i < w->end; ++i) {
    const Bounds b = item_bounds(&items[i]);
    const Packed box = packed(b);
    const float3 c = centre2(b);
    const uint at[3] = {bin_of(c.x, w->lo[0], w->hi[0]), bin_of(c.y, w->lo[1], w->hi[1]),
                        bin_of(c.z, w->lo[2], w->hi[2])};
    for (uint axis = 0u; axis < 3u; ++axis) {
      bins->box[axis][at[axis]] = joined_packed(box, bins->box[axis][at[axis]]);
      bins->weight[axis][at[axis]] += FACET_SIZE_OF(items[i].size);
      ++bins->items[axis][at[axis]];
    }
  }
}

// axis is SPLIT_BY_INDEX where no split by bins parts the range at a finite cost.
static inline SerialSplit best_bins(const Bins* bins) {
  SerialSplit best;
  best.cost = INFINITY;
  best.axis = SPLIT_BY_INDEX;
  best.left = 0u;
  best.left_box = best.right_box = no_packed();
  for (uint axis = 0u; axis < 3u; ++axis) {
    Packed right[BINS];
    uint right_weight[BINS], right_items[BINS];
    Packed box = no_packed();
    uint weight = 0u, items = 0u;
    for (uint k = BINS - 1u; k > 0u; --k) {
      box = joined_packed(bins->box[axis][k], box);
      weight += bins->weight[axis][k], items += bins->items[axis][k];
      right[k] = box, right_weight[k] = weight, right_items[k] = items;
    }
    box = no_packed();
    weight = items = 0u;
    for (uint k = 1u; k < BINS; ++k) {
      box = joined_packed(bins->box[axis][k - 1u], box);
      weight += bins->weight[axis][k - 1u], items += bins->items[axis][k - 1u];
      if (items == 0u || right_items[k] == 0u) continue;
      const float cost = packed_cost(box, (float)weight, right[k], (float)right_weight[k]);
      if (cost < best.cost) best.cost = cost, best.axis = axis, best.left = k;
    }
  }
  return best;
}

// Moves a range's items so that those on the left come first; tells of both sides' boxes.
static inline uint part_items(__global Item* items, const Waiting* w, uint axis, uint bin, Packed box[2]) {
  box[0] = box[1] = no_packed();
  uint next = w->begin, end = w->end;
  while (next < end) {
    const Item item = items[next];
    uint k;
    if (axis == SPLIT_BY_INDEX) k = item.index <= bin ? 0u : 1u;
    else k = bin_of(item.lo[axis] + item.hi[axis], w->lo[axis], w->hi[axis]) < bin ? 0u : 1u;
    box[k] = joined_packed(packed(item_bounds(&items[next])), box[k]);
    if (k == 0u) {
      ++next;
    } else {
      --end;
      items[next] = items[end];
      items[end] = item;
    }
  }
  return next;
}

// A small range's tree; returns the deepest leaf's depth.
static inline uint finish_range(__global const Item* items, const Waiting* w, __global Node* nodes,
                                __global const uint* refs) {
  const uint count = w->end - w->begin;
  Entries e;
  for (uint i = 0u; i < count; ++i) {
    __global const Item* item = &items[w->begin + i];
    put_entry(&e, i, item_bounds(item), item->index, FACET_SIZE_OF(item->size));
  }
  Node made[31];
  Orders orders;
  Segment leaves[32];
  uint leaf_count, deepest = 0u;
  const uint made_count = serial_sweep(&e, count, 1u, 1u, w->node, made, &orders, leaves, &leaf_count);
  for (uint i = 0u; i < leaf_count; ++i) {
    const uint at = orders.by[3][leaves[i].begin];
    made[leaves[i].link >> 1].child[leaves[i].link & 1u] = refs[e.tie[at]];
    deepest = max(deepest, w->depth + leaves[i].depth + FACET_HEIGHT_OF(items[w->begin + at].size));
  }
  for (uint i = 0u; i < made_count; ++i) nodes[w->node + i] = made[i];
  return deepest;
}

// As cl/top.cl, over count > 1 items; counter[1]: the deepest leaf.
__kernel void build_top(__global Item* items, __global const Curve* curve, __global Node* nodes,
                        __global const uint* refs, __global uint* counter, uint count) {
  // Of the ranges that wait, one is left by each level at most: depths are below TOP_SWEPT_DEPTH + 32.
  Waiting stack[TOP_SWEPT_DEPTH + 34u];
  uint top = 0u, deepest = 0u;
  Waiting all;
  all.begin = 0u, all.end = count, all.node = 0u, all.depth = 0u;
  for (uint a = 0u; a < 3u; ++a) all.lo[a] = curve->lo[a], all.hi[a] = curve->hi[a];
  all.first = 0u, all.last = count - 1u;
  stack[top++] = all;
  while (top > 0u) {
    const Waiting w = stack[--top];
    if (w.end - w.begin <= SWEEP_MOST) {
      deepest = max(deepest, finish_range(items, &w, nodes, refs));
      continue;
    }
    SerialSplit split;
    split.axis = SPLIT_BY_INDEX;
    if (w.depth < TOP_SWEPT_DEPTH) {
      Bins bins;
      serial_bins(items, &w, &bins);
      split = best_bins(&bins);
    }
    if (split.axis == SPLIT_BY_INDEX) split.left = middle_index(w.first, w.last);
    Packed box[2];
    const uint middle = part_items(items, &w, split.axis, split.left, box);
    if (middle == w.begin || middle == w.end) {
      Waiting same = w;
      if (middle == w.begin) same.first = split.left + 1u;
      else same.last = split.left;
      stack[top++] = same;
      continue;
    }
    Waiting side[2] = {w, w};
    side[0].end = middle, side[0].node = w.node + 1u;
    side[1].begin = middle, side[1].node = w.node + (middle - w.begin);
    Node n;
    for (uint k = 0u; k < 2u; ++k) {
      put_packed(&n, k, box[k]);
      side[k].depth = w.depth + 1u;
      side[k].lo[0] = 2.0f * box[k].s0, side[k].lo[1] = 2.0f * box[k].s1, side[k].lo[2] = 2.0f * box[k].s2;
      side[k].hi[0] = -2.0f * box[k].s4, side[k].hi[1] = -2.0f * box[k].s5, side[k].hi[2] = -2.0f * box[k].s6;
      n.spare[k] = 0u;
      if (side[k].end - side[k].begin == 1u) {
        n.child[k] = refs[items[side[k].begin].index];
        deepest = max(deepest, side[k].depth + FACET_HEIGHT_OF(items[side[k].begin].size));
      } else {
        n.child[k] = side[k].node;
      }
    }
    nodes[w.node] = n;
    for (uint k = 2u; k-- > 0u;)
      if (side[k].end - side[k].begin > 1u) stack[top++] = side[k];
  }
  counter[1] = deepest;
}
