// The trees of cl/bottom.cl and cl/top.cl, a work-item to each: for devices whose work-items are the
// cores of a CPU. The same boxes give the same tree.
#include "bins.h"
#include "serial_sweep.h"

// As build_bottoms of cl/bottom.cl, `each` subtrees a work-item.
__kernel void build_bottoms(PRIMITIVES_ARGUMENT, __global const uint* starts, __global uint* order,
                            __global Node* nodes, __global Item* items, __global uint* refs,
                            __global uint* counter, uint room, uint subtrees, uint each,
                            uint leaf_sure, uint leaf_most, uint leaf_block_bit) {
  const LeafRule rule = {leaf_sure, leaf_most, leaf_block_bit};
  const uint begin = (uint)get_global_id(0) * each, end = min(begin + each, subtrees);
  const uint beyond = begin < end ? starts[end] : 0u;  // other work-items' order
  for (uint k = begin; k < end; ++k) {
    const uint first = starts[k], count = starts[k + 1u] - first;
    Entries e;
    uint primitive[32];
    Packed all = no_packed();
    begin_entries(&e);
    for (uint i = 0u; i < count; ++i) {
      const uint ahead = first + i + PRIMITIVES_AHEAD;
      if (ahead < beyond) fetch_primitive(PRIMITIVE(order[ahead]));
      primitive[i] = order[first + i];
      put_entry(&e, i, bounds_at(PRIMITIVE(primitive[i])), 1u);
      all = joined_packed(e.box[i], all);
    }
    Node made[31];
    Segment leaves[32];
    uint leaf_count, height = 0u, at = first;
    const uint made_count = serial_sweep(&e, count, rule, 0u, made, leaves, &leaf_count);
    // What does not fit is counted all the same: the host makes room and starts again.
    const uint base = made_count == 0u ? 0u : atomic_add((volatile __global uint*)counter, made_count);
    for (uint i = 0u; i < made_count; ++i)
      for (uint side = 0u; side < 2u; ++side) made[i].child[side] += base;
    for (uint i = 0u; i < leaf_count; ++i) {
      const Segment* l = &leaves[i];
      if (l->link != FACET_NONE) made[l->link >> 1].child[l->link & 1u] = FACET_LEAF(at, popcount(l->entries));
      height = max(height, l->depth);
      for (uint left = l->entries; left != 0u; left = without_first(left)) order[at++] = primitive[first_lane(left)];
    }
    if (base + made_count <= room)
      for (uint i = 0u; i < made_count; ++i) nodes[base + i] = made[i];
    Item item;
    item.lo[0] = all.s0, item.lo[1] = all.s1, item.lo[2] = all.s2, item.index = k;
    item.hi[0] = -all.s4, item.hi[1] = -all.s5, item.hi[2] = -all.s6;
    item.size = count | height << FACET_HEIGHT_BIT;
    items[k] = item;
    refs[k] = made_count == 0u ? FACET_LEAF(first, count) : base;
  }
}

typedef struct {
  Packed box[3][BINS];
  uint weight[3][BINS], items[3][BINS];
} Bins;

static inline void serial_bins(__global const Item* items, const TopRange* w, Bins* bins) {
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
static inline uint part_items(__global Item* items, const TopRange* w, uint axis, uint bin, Packed box[2]) {
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
static inline uint finish_range(__global const Item* items, const TopRange* w, __global Node* nodes,
                                __global const uint* refs) {
  const uint count = w->end - w->begin;
  // Entries come in the order of indices, which breaks ties.
  uchar place[32];
  for (uint i = 0u; i < count; ++i) {
    uint k = i;
    for (; k > 0u && items[w->begin + place[k - 1u]].index > items[w->begin + i].index; --k) place[k] = place[k - 1u];
    place[k] = (uchar)i;
  }
  Entries e;
  begin_entries(&e);
  for (uint i = 0u; i < count; ++i) {
    __global const Item* item = &items[w->begin + place[i]];
    put_entry(&e, i, item_bounds(item), FACET_SIZE_OF(item->size));
  }
  Node made[31];
  Segment leaves[32];
  uint leaf_count, deepest = 0u;
  const LeafRule one_each = {1u, 1u, 0u};
  const uint made_count = serial_sweep(&e, count, one_each, w->node, made, leaves, &leaf_count);
  for (uint i = 0u; i < leaf_count; ++i) {
    __global const Item* item = &items[w->begin + place[first_lane(leaves[i].entries)]];
    made[leaves[i].link >> 1].child[leaves[i].link & 1u] = refs[item->index];
    deepest = max(deepest, w->depth + leaves[i].depth + FACET_HEIGHT_OF(item->size));
  }
  for (uint i = 0u; i < made_count; ++i) nodes[w->node + i] = made[i];
  return deepest;
}

// Splits a range of more than SWEEP_MOST items, as cl/top.cl does. Returns how many ranges of two items and more
// it leaves, in side[]: the range itself, where its items' indices alone are fewer now.
static inline uint split_range(__global Item* items, const TopRange* w, __global Node* nodes,
                               __global const uint* refs, TopRange side[2], uint* deepest) {
  SerialSplit split;
  split.axis = SPLIT_BY_INDEX;
  if (w->depth < TOP_SWEPT_DEPTH) {
    Bins bins;
    serial_bins(items, w, &bins);
    split = best_bins(&bins);
  }
  if (split.axis == SPLIT_BY_INDEX) split.left = middle_index(w->first, w->last);
  Packed box[2];
  uint middle = part_items(items, w, split.axis, split.left, box);
  if ((middle == w->begin || middle == w->end) && split.axis != SPLIT_BY_INDEX) {
    // Both sides have bins: only a variant's compiler, which may round as it likes, finds other bins here.
    split.axis = SPLIT_BY_INDEX, split.left = middle_index(w->first, w->last);
    middle = part_items(items, w, split.axis, split.left, box);
  }
  side[0] = side[1] = *w;
  if (middle == w->begin || middle == w->end) {
    if (middle == w->begin) side[0].first = split.left + 1u;
    else side[0].last = split.left;
    return 1u;
  }
  const uint at = w->node, depth = w->depth + 1u;
  side[0].end = middle, side[0].node = at + 1u;
  side[1].begin = middle, side[1].node = at + (middle - w->begin);
  uint left = 0u;
  Node n;
  for (uint k = 0u; k < 2u; ++k) {
    TopRange s = side[k];
    put_packed(&n, k, box[k]);
    n.spare[k] = 0u;
    s.depth = depth;
    s.lo[0] = 2.0f * box[k].s0, s.lo[1] = 2.0f * box[k].s1, s.lo[2] = 2.0f * box[k].s2;
    s.hi[0] = -2.0f * box[k].s4, s.hi[1] = -2.0f * box[k].s5, s.hi[2] = -2.0f * box[k].s6;
    if (s.end - s.begin == 1u) {
      n.child[k] = refs[items[s.begin].index];
      *deepest = max(*deepest, depth + FACET_HEIGHT_OF(items[s.begin].size));
    } else {
      n.child[k] = s.node;
      side[left++] = s;
    }
  }
  nodes[at] = n;
  return left;
}

static inline uint finish_top(__global Item* items, const TopRange* range, __global Node* nodes,
                              __global const uint* refs) {
  // Of the ranges that wait, one is left by each level at most: depths are below TOP_SWEPT_DEPTH + 32.
  TopRange stack[TOP_SWEPT_DEPTH + 34u];
  uint top = 0u, deepest = 0u;
  stack[top++] = *range;
  while (top > 0u) {
    const TopRange w = stack[--top];
    if (w.end - w.begin <= SWEEP_MOST) {
      deepest = max(deepest, finish_range(items, &w, nodes, refs));
      continue;
    }
    TopRange side[2];
    for (uint left = split_range(items, &w, nodes, refs, side, &deepest); left > 0u; --left)
      stack[top++] = side[left - 1u];
  }
  return deepest;
}

// Smaller ranges are not shared out.
#define SHARED_ITEMS (2u * SWEEP_MOST)

// Splits the largest range until there are `open`, or none is large.
static inline uint open_top(__global Item* items, __global const Curve* curve, __global Node* nodes,
                            __global const uint* refs, __global TopRange* ranges, uint count, uint open,
                            uint* deepest) {
  TopRange all;
  all.begin = 0u, all.end = count, all.node = 0u, all.depth = 0u;
  for (uint a = 0u; a < 3u; ++a) all.lo[a] = curve->lo[a], all.hi[a] = curve->hi[a];
  all.first = 0u, all.last = count - 1u;
  all.buffer = all.spare[0] = all.spare[1] = all.spare[2] = 0u;
  ranges[0] = all;
  uint found = 1u;
  while (found > 0u && found < open) {
    uint largest = 0u;
    for (uint i = 1u; i < found; ++i)
      if (ranges[i].end - ranges[i].begin > ranges[largest].end - ranges[largest].begin) largest = i;
    const TopRange w = ranges[largest];
    if (w.end - w.begin < SHARED_ITEMS) break;
    TopRange side[2];
    const uint left = split_range(items, &w, nodes, refs, side, deepest);
    ranges[largest] = left > 0u ? side[0] : ranges[--found];
    if (left > 1u) ranges[found++] = side[1];
  }
  return found;
}

// As cl/top.cl, over count > 1 items: in the first step one work-item finds up to `open` ranges, then each has one.
// counter[0]: the ranges; counter[1]: the deepest leaf.
__kernel void build_top(__global Item* items, __global const Curve* curve, __global Node* nodes,
                        __global const uint* refs, __global TopRange* ranges, volatile __global uint* counter,
                        uint count, uint open, uint step) {
  const uint i = (uint)get_global_id(0);
  uint deepest = 0u;
  if (step == 0u) {
    counter[0] = open_top(items, curve, nodes, refs, ranges, count, open, &deepest);
    counter[1] = deepest;
  } else if (i < counter[0]) {
    const TopRange own = ranges[i];
    atomic_max(&counter[1], finish_top(items, &own, nodes, refs));
  }
}
