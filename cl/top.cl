// The top tree: over the items that cl/bottom.cl leaves, from the root down, a level a launch. Work is cut
// into tiles of a range's items, a group each. A range of one tile is split by its group; one of
// several has its bins filled by bin_items first. Ranges of up to SWEEP_MOST items are left to
// finish_ranges.
//
// The order of a range's items varies from run to run; bounds, sums and splits do not depend on it.
#define LEAF_SURE 1u
#define LEAF_MOST 1u
#include "sweep.h"
#include "bins.h"

#define TILE_ITEMS (GROUP * TILE_EACH)
#ifndef GROUP
#define GROUP 256u
#endif
#ifndef TILE_EACH
#define TILE_EACH 4u
#endif

// What a level has, in counters + 4 * level.
#define LEVEL_RANGES 0u
#define LEVEL_TILES 1u
#define LEVEL_BINS 2u
// In counters + TOTALS: small ranges, and the deepest leaf.
#define TOTALS 1024u

static inline void clear_bins(__local uint* bins, uint lid) {
  for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) {
    const uint word = i % BIN_WORDS;
    bins[i] = word < 3u ? ORDERED_MOST : 0u;
  }
}

static inline void fill_bins(__local uint* bins, Bounds b, uint size, float3 lo, float3 hi) {
  const float3 c = centre2(b);
  const uint at[3] = {bin_of(c.x, lo.x, hi.x), bin_of(c.y, lo.y, hi.y), bin_of(c.z, lo.z, hi.z)};
  for (uint axis = 0u; axis < 3u; ++axis) {
    __local uint* bin = bins + (axis * BINS + at[axis]) * BIN_WORDS;
    atomic_min(&bin[0], ordered(b.lo.x)), atomic_min(&bin[1], ordered(b.lo.y));
    atomic_min(&bin[2], ordered(b.lo.z));
    atomic_max(&bin[3], ordered(b.hi.x)), atomic_max(&bin[4], ordered(b.hi.y));
    atomic_max(&bin[5], ordered(b.hi.z));
    atomic_add(&bin[6], size);
    atomic_add(&bin[7], 1u);
  }
}

// Words of TopSides: the first ones hold what atomics make smaller, then come the counts, then what they
// make larger.
#define SIDES_MIN 14u
#define SIDES_COUNT 14u
#define SIDES_MAX 16u
#define SIDES_END 30u
#define SIDES_WORDS 32u

static inline uint empty_side_word(uint word) { return word < SIDES_MIN ? ORDERED_MOST : ORDERED_LEAST; }

static inline float3 unordered3(__global const uint* a) {
  return (float3)(unordered(a[0]), unordered(a[1]), unordered(a[2]));
}

// The range of all items: bounds are the curve's, which hold all centres or are near them.
__kernel void start_top(__global const Curve* curve, __global TopRange* ranges, __global TopSides* before,
                        __global TopSides* sides, __global uint* tiles, __global uint* bins,
                        __global TopRange* small, __global uint* counters, uint count) {
  const uint id = (uint)get_global_id(0), ids = (uint)get_global_size(0);
  const uint tile_count = (count + TILE_ITEMS - 1u) / TILE_ITEMS;
  for (uint i = id; i < tile_count; i += ids) tiles[2u * i] = 0u, tiles[2u * i + 1u] = i;
  for (uint i = id; i < ALL_BIN_WORDS; i += ids) bins[i] = i % BIN_WORDS < 3u ? ORDERED_MOST : 0u;
  for (uint i = id; i < SIDES_WORDS; i += ids) ((__global uint*)sides)[i] = empty_side_word(i);
  if (id != 0u) return;
  TopRange r;
  r.begin = 0u, r.end = count, r.node = 0u, r.depth = 0u;
  r.parent = 0u, r.side = 0u, r.buffer = 0u;
  r.bins = tile_count > 1u ? 0u : FACET_NONE;
  if (count <= SWEEP_MOST) {
    small[0] = r;
    counters[TOTALS] = 1u;
    return;
  }
  ranges[0] = r;
  for (uint k = 0u; k < 3u; ++k) {
    before->centre_lo[0][k] = ordered(curve->lo[k]);
    before->centre_hi[0][k] = ordered(curve->hi[k]);
  }
  before->first[0] = 0u;
  before->last[0] = count - 1u;
  counters[LEVEL_RANGES] = 1u;
  counters[LEVEL_TILES] = tile_count;
  counters[LEVEL_BINS] = 1u;
}

// Fills the bins of ranges of several tiles; before: the sides of the level before.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void bin_items(
    __global const Item* items, __global const TopRange* ranges, __global const TopSides* before,
    __global const uint* tiles, __global uint* bins, __global const uint* counters, uint level,
    __local uint* own) {
  const uint lid = (uint)get_local_id(0), tile = (uint)get_group_id(0);
  // A group without work goes through all the same: PoCL 3.1 has trouble with barriers after a return.
  const bool is_there = tile < counters[4u * level + LEVEL_TILES];
  const TopRange r = ranges[is_there ? tiles[2u * tile] : 0u];
  const bool works = is_there && r.bins != FACET_NONE;
  clear_bins(own, lid);
  barrier(CLK_LOCAL_MEM_FENCE);
  __global const TopSides* up = before + (works ? r.parent : 0u);
  const uint side = works ? r.side : 0u;
  const float3 lo = unordered3(up->centre_lo[side]), hi = unordered3(up->centre_hi[side]);
  const uint begin = works ? r.begin + tiles[2u * tile + 1u] * TILE_ITEMS : 0u;
  const uint end = works ? min(begin + TILE_ITEMS, r.end) : 0u;
  for (uint i = begin + lid; i < end; i += GROUP)
    fill_bins(own, item_bounds(&items[i]), FACET_SIZE_OF(items[i].size), lo, hi);
  barrier(CLK_LOCAL_MEM_FENCE);
  volatile __global uint* to = bins + (works ? r.bins * ALL_BIN_WORDS : 0u);
  for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) {
    if (own[i / BIN_WORDS * BIN_WORDS + 7u] == 0u) continue;
    const uint word = i % BIN_WORDS;
    if (word < 3u) atomic_min(&to[i], own[i]);
    else if (word < 6u) atomic_max(&to[i], own[i]);
    else atomic_add(&to[i], own[i]);
  }
}

typedef struct {
  Bounds bounds;
  float weight;
  uint items;
} BinSum;

static inline BinSum sum_bins(__local const uint* bins, uint axis, uint begin, uint end) {
  BinSum s;
  s.bounds = no_bounds();
  s.items = 0u;
  uint weight = 0u;
  for (uint k = begin; k < end; ++k) {
    __local const uint* bin = bins + (axis * BINS + k) * BIN_WORDS;
    if (bin[7] == 0u) continue;
    Bounds b;
    b.lo = (float3)(unordered(bin[0]), unordered(bin[1]), unordered(bin[2]));
    b.hi = (float3)(unordered(bin[3]), unordered(bin[4]), unordered(bin[5]));
    s.bounds = joined(s.bounds, b);
    weight += bin[6];
    s.items += bin[7];
  }
  s.weight = (float)weight;
  return s;
}

// Local memory of split_ranges, in words.
#define SPLIT_COSTS ALL_BIN_WORDS           // one a candidate
#define SPLIT_SIDES (SPLIT_COSTS + 3u * BINS)  // the tile's own TopSides
#define SPLIT_CHOICE (SPLIT_SIDES + SIDES_WORDS)  // axis and bin; then each side's items of other tiles
#define SPLIT_WORDS (SPLIT_CHOICE + 4u)

static inline uint side_of(const Item item, uint axis, uint bin, float lo, float hi) {
  if (axis == SPLIT_BY_INDEX) return item.index <= bin ? 0u : 1u;
  return bin_of(item.lo[axis] + item.hi[axis], lo, hi) < bin ? 0u : 1u;
}

// Splits each of a level's ranges: its items move from `items` to `moved`, those on the left from the
// range's begin on, those on the right from its end down; what the sides hold goes to `sides`.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void split_ranges(
    __global const Item* items, __global Item* moved, __global const TopRange* ranges,
    __global const TopSides* before, __global TopSides* sides, __global const uint* tiles,
    __global const uint* bins, __global const uint* counters, uint level, __local uint* pool) {
  const uint lid = (uint)get_local_id(0), tile = (uint)get_group_id(0);
  if (tile >= counters[4u * level + LEVEL_TILES]) return;
  const uint at = tiles[2u * tile];
  const TopRange r = ranges[at];
  __global const TopSides* up = before + r.parent;
  const float3 lo = unordered3(up->centre_lo[r.side]), hi = unordered3(up->centre_hi[r.side]);
  const uint begin = r.begin + tiles[2u * tile + 1u] * TILE_ITEMS, end = min(begin + TILE_ITEMS, r.end);
  __local uint* own = pool + SPLIT_SIDES;
  const bool has_bins = r.bins != FACET_NONE;
  if (!has_bins) clear_bins(pool, lid);
  else
    for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) pool[i] = bins[r.bins * ALL_BIN_WORDS + i];
  if (lid < SIDES_WORDS) own[lid] = empty_side_word(lid);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (!has_bins)
    for (uint i = begin + lid; i < end; i += GROUP)
      fill_bins(pool, item_bounds(&items[i]), FACET_SIZE_OF(items[i].size), lo, hi);
  barrier(CLK_LOCAL_MEM_FENCE);

  // Candidate c puts bins below c % BINS of an axis on the left.
  if (lid < 3u * BINS) {
    const BinSum left = sum_bins(pool, lid / BINS, 0u, lid % BINS);
    const BinSum right = sum_bins(pool, lid / BINS, lid % BINS, BINS);
    const bool is_split = left.items != 0u && right.items != 0u && r.depth < TOP_SWEPT_DEPTH;
    pool[SPLIT_COSTS + lid] =
        as_uint(is_split ? split_cost(left.bounds, left.weight, right.bounds, right.weight) : INFINITY);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lid == 0u) {
    uint best = 0u;
    for (uint c = 1u; c < 3u * BINS; ++c)
      if (as_float(pool[SPLIT_COSTS + c]) < as_float(pool[SPLIT_COSTS + best])) best = c;
    const bool is_by_bins = as_float(pool[SPLIT_COSTS + best]) < INFINITY;
    pool[SPLIT_CHOICE] = is_by_bins ? best / BINS : SPLIT_BY_INDEX;
    pool[SPLIT_CHOICE + 1u] =
        is_by_bins ? best % BINS : up->first[r.side] + (up->last[r.side] - up->first[r.side]) / 2u;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint axis = pool[SPLIT_CHOICE], bin = pool[SPLIT_CHOICE + 1u];
  const float axis_lo = axis == 0u ? lo.x : axis == 1u ? lo.y : lo.z,
              axis_hi = axis == 0u ? hi.x : axis == 1u ? hi.y : hi.z;

  uint rank[TILE_EACH];  // among the tile's items of its side; the side is the highest bit
  for (uint k = 0u; k < TILE_EACH; ++k) {
    const uint i = begin + k * GROUP + lid;
    rank[k] = 0u;
    if (i >= end) continue;
    const Item item = items[i];
    const uint side = side_of(item, axis, bin, axis_lo, axis_hi);
    rank[k] = atomic_inc(&own[SIDES_COUNT + side]) | side << 31;
    for (uint a = 0u; a < 3u; ++a) {
      const uint centre = ordered(item.lo[a] + item.hi[a]);
      atomic_min(&own[3u * side + a], ordered(item.lo[a]));
      atomic_min(&own[6u + 3u * side + a], centre);
      atomic_max(&own[SIDES_MAX + 3u * side + a], ordered(item.hi[a]));
      atomic_max(&own[SIDES_MAX + 6u + 3u * side + a], centre);
    }
    atomic_min(&own[12u + side], item.index);
    atomic_max(&own[SIDES_MAX + 12u + side], item.index);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  volatile __global uint* all = (volatile __global uint*)(sides + at);
  if (lid < SIDES_MIN) atomic_min(&all[lid], own[lid]);
  else if (lid < SIDES_MAX) pool[SPLIT_CHOICE + 2u + lid - SIDES_COUNT] = atomic_add(&all[lid], own[lid]);
  else if (lid < SIDES_END) atomic_max(&all[lid], own[lid]);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = 0u; k < TILE_EACH; ++k) {
    const uint i = begin + k * GROUP + lid;
    if (i >= end) continue;
    const uint side = rank[k] >> 31, place = (rank[k] & 0x7fffffffu) + pool[SPLIT_CHOICE + 2u + side];
    moved[side == 0u ? r.begin + place : r.end - 1u - place] = items[i];
  }
}

// Writes each split range's node and lists what its sides become. `level` is theirs; next_sides are made
// ready for the next one's.
__kernel void list_ranges(__global const Item* moved, __global const TopRange* ranges,
                          __global const TopSides* sides, __global TopRange* next_ranges,
                          __global TopSides* next_sides, __global uint* next_tiles, __global uint* next_bins,
                          __global TopRange* small, __global Node* nodes, __global const uint* refs,
                          __global uint* counters, uint level) {
  const uint at = (uint)get_global_id(0);
  if (at >= counters[4u * level + LEVEL_RANGES]) return;
  const TopRange r = ranges[at];
  volatile __global uint* next = (volatile __global uint*)(counters + 4u * (level + 1u));
  volatile __global uint* totals = (volatile __global uint*)(counters + TOTALS);
  const uint left = sides[at].count[0];
  Node node;
  for (uint side = 0u; side < 2u; ++side) {
    const float3 lo = unordered3(sides[at].lo[side]), hi = unordered3(sides[at].hi[side]);
    node.x[0][side] = lo.x, node.y[0][side] = lo.y, node.z[0][side] = lo.z;
    node.x[1][side] = hi.x, node.y[1][side] = hi.y, node.z[1][side] = hi.z;
    node.spare[side] = 0u;
    TopRange c;
    c.begin = side == 0u ? r.begin : r.begin + left;
    c.end = side == 0u ? r.begin + left : r.end;
    c.node = side == 0u ? r.node + 1u : r.node + left;
    c.depth = r.depth + 1u;
    c.parent = at, c.side = side, c.bins = FACET_NONE, c.buffer = r.buffer ^ 1u;
    const uint count = c.end - c.begin;
    if (count == 1u) {
      node.child[side] = refs[moved[c.begin].index];
      atomic_max(&totals[1], c.depth + FACET_HEIGHT_OF(moved[c.begin].size));
      continue;
    }
    node.child[side] = c.node;
    if (count <= SWEEP_MOST) {
      small[atomic_inc(&totals[0])] = c;
      continue;
    }
    const uint to = atomic_inc(&next[LEVEL_RANGES]), tile_count = (count + TILE_ITEMS - 1u) / TILE_ITEMS;
    if (tile_count > 1u) {
      c.bins = atomic_inc(&next[LEVEL_BINS]);
      __global uint* empty = next_bins + c.bins * ALL_BIN_WORDS;
      for (uint i = 0u; i < ALL_BIN_WORDS; ++i) empty[i] = i % BIN_WORDS < 3u ? ORDERED_MOST : 0u;
    }
    const uint first = atomic_add(&next[LEVEL_TILES], tile_count);
    for (uint t = 0u; t < tile_count; ++t) {
      next_tiles[2u * (first + t)] = to;
      next_tiles[2u * (first + t) + 1u] = t;
    }
    for (uint i = 0u; i < SIDES_WORDS; ++i) ((__global uint*)(next_sides + to))[i] = empty_side_word(i);
    next_ranges[to] = c;
  }
  nodes[r.node] = node;
}

// Trees over the small ranges, a group to each.
__kernel __attribute__((reqd_work_group_size(32, 1, 1))) void finish_ranges(
    __global const Item* even, __global const Item* odd, __global const TopRange* small, __global Node* nodes,
    __global const uint* refs, __global uint* counters, __local uint* pool) {
  const uint lane = (uint)get_local_id(0);
  const TopRange r = small[get_group_id(0)];
  const uint count = r.end - r.begin;
  __global const Item* item = (r.buffer == 0u ? even : odd) + r.begin + min(lane, count - 1u);
  put_sweep_box((__local float*)pool, lane, item_bounds(item));
  pool[SWEEP_TIE + lane] = item->index;
  pool[SWEEP_WEIGHT + lane] = FACET_SIZE_OF(item->size);
  const uint height = FACET_HEIGHT_OF(item->size);
  const Swept t = sweep_tree(lane, count, r.node, pool);
  barrier(CLK_LOCAL_MEM_FENCE);
  pool[SWEEP_WEIGHT + lane] = height;
  if (lane == 0u) pool[SWEEP_MASK] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < count) {
    pool[SWEEP_NODES + 16u * (t.link >> 1) + NODE_CHILD + (t.link & 1u)] = refs[pool[SWEEP_TIE + lane]];
    atomic_max(&pool[SWEEP_MASK], r.depth + t.depth + pool[SWEEP_WEIGHT + t.moved_from]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = lane; i < 16u * t.nodes; i += 32u) {
    const uint word = i % 16u, value = pool[SWEEP_NODES + i];
    ((__global uint*)(nodes + r.node))[i] = word >= NODE_CHILD + 2u ? 0u : value;
  }
  if (lane == 0u) atomic_max((volatile __global uint*)&counters[TOTALS + 1u], pool[SWEEP_MASK]);
}
