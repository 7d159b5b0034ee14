// The top tree: over the items that cl/bottom.cl leaves, from the root down, a level at a time. While
// ranges are large, several groups work on one, a tile of its items each, in three launches a level:
// bin_tiles, move_tiles, list_ranges. Then a group splits a range, in one launch: split_ranges. Ranges of
// up to SWEEP_MOST items are left to finish_ranges.
//
// The order of a range's items varies from run to run; bounds, sums and splits do not depend on it.
#define FACET_SWEEP_WEIGHTS
#define LEAF_SURE 1u
#define LEAF_MOST 1u
#include "bin_split.h"
#include "sweep.h"

#define GROUP FACET_TOP_GROUP
#define TILE_ITEMS FACET_TILE_ITEMS
// A group that splits a range alone.
#ifndef SPLIT_GROUP
#define SPLIT_GROUP 64u
#endif

// What a level has, in counters + LEVEL_WORDS * level.
#define LEVEL_WORDS FACET_LEVEL_WORDS
#define LEVEL_RANGES 0u
#define LEVEL_TILES 1u
// In counters + TOTALS: small ranges, and the deepest leaf.
#define TOTALS FACET_TOTALS

// Where what becomes of a split range goes.
typedef struct {
  __global TopRange* ranges;  // of the next level
  __global uint* tiles;       // and its tiles, while there are any; else 0
  __global TopSides* sides;
  __global uint* bins;
  __global TopRange* small;
  __global Node* nodes;
  __global const uint* refs;
  __global uint* counters;
} Lists;

// next: the next level's counters.
static inline void push_range(const Lists* to, const TopRange c, volatile __global uint* next) {
  if (c.end - c.begin <= SWEEP_MOST) {
    to->small[atomic_inc((volatile __global uint*)&to->counters[TOTALS])] = c;
    return;
  }
  const uint at = atomic_inc(&next[LEVEL_RANGES]);
  to->ranges[at] = c;
  if (to->tiles == 0) return;
  const uint tile_count = (c.end - c.begin + TILE_ITEMS - 1u) / TILE_ITEMS;
  const uint first = atomic_add(&next[LEVEL_TILES], tile_count);
  for (uint t = 0u; t < tile_count; ++t) {
    to->tiles[2u * (first + t)] = at;
    to->tiles[2u * (first + t) + 1u] = t;
  }
  for (uint i = 0u; i < 2u; ++i) to->sides[at].count[i] = 0u;
  for (uint i = 0u; i < 6u; ++i) {
    to->sides[at].lo[i / 3u][i % 3u] = ORDERED_MOST;
    to->sides[at].hi[i / 3u][i % 3u] = ORDERED_LEAST;
  }
  for (uint i = 0u; i < ALL_BIN_WORDS; ++i) to->bins[at * ALL_BIN_WORDS + i] = empty_bin_word(i);
}

// Writes a split range's node and lists its two sides, whose items are in `moved`.
static inline void list_sides(const Lists* to, const TopRange r, const TopSides s, __global const Item* moved,
                              volatile __global uint* next) {
  const uint left = s.count[0];
  if (left == 0u || left == r.end - r.begin) {
    TopRange same = r;
    if (left == 0u) same.first = middle_index(r.first, r.last) + 1u;
    else same.last = middle_index(r.first, r.last);
    same.buffer ^= 1u;
    push_range(to, same, next);
    return;
  }
  Node node;
  for (uint side = 0u; side < 2u; ++side) {
    const Bounds b = unordered_bounds(s.lo[side], s.hi[side]);
    node.x[0][side] = b.lo.x, node.y[0][side] = b.lo.y, node.z[0][side] = b.lo.z;
    node.x[1][side] = b.hi.x, node.y[1][side] = b.hi.y, node.z[1][side] = b.hi.z;
    node.spare[side] = 0u;
    TopRange c = r;
    if (side == 0u) c.end = r.begin + left;
    else c.begin = r.begin + left;
    c.node = side == 0u ? r.node + 1u : r.node + left;
    c.depth = r.depth + 1u;
    c.lo[0] = 2.0f * b.lo.x, c.lo[1] = 2.0f * b.lo.y, c.lo[2] = 2.0f * b.lo.z;
    c.hi[0] = 2.0f * b.hi.x, c.hi[1] = 2.0f * b.hi.y, c.hi[2] = 2.0f * b.hi.z;
    c.buffer = r.buffer ^ 1u;
    node.child[side] = c.node;
    if (c.end - c.begin > 1u) {
      push_range(to, c, next);
      continue;
    }
    node.child[side] = to->refs[moved[c.begin].index];
    atomic_max((volatile __global uint*)&to->counters[TOTALS + 1u],
               c.depth + FACET_HEIGHT_OF(moved[c.begin].size));
  }
  to->nodes[r.node] = node;
}

// The range of all items, as the only one of level 0.
__kernel void start_top(__global const Curve* curve, __global TopRange* ranges, __global uint* tiles,
                        __global TopSides* sides, __global uint* bins, __global TopRange* small,
                        __global uint* counters, uint count, uint is_tiled) {
  for (uint i = (uint)get_local_id(0); i < TOTALS + 2u; i += (uint)get_local_size(0)) counters[i] = 0u;
  barrier(CLK_GLOBAL_MEM_FENCE);
  if (get_local_id(0) != 0u) return;
  TopRange r;
  r.begin = 0u, r.end = count, r.node = 0u, r.depth = 0u;
  for (uint k = 0u; k < 3u; ++k) r.lo[k] = curve->lo[k], r.hi[k] = curve->hi[k], r.spare[k] = 0u;
  r.first = 0u, r.last = count - 1u, r.buffer = 0u;
  Lists to;
  to.ranges = ranges, to.tiles = is_tiled != 0u ? tiles : 0, to.sides = sides, to.bins = bins;
  to.small = small, to.nodes = 0, to.refs = 0, to.counters = counters;
  push_range(&to, r, (volatile __global uint*)counters);
}

// A tile's items are spread over its range, so that few of a group's meet at one bin.
typedef struct {
  uint begin, step, end;
} Spread;

static inline Spread tile_items(const TopRange* r, uint part) {
  const uint parts = (r->end - r->begin + TILE_ITEMS - 1u) / TILE_ITEMS;
  Spread s;
  s.begin = r->begin + part + parts * (uint)get_local_id(0);
  s.step = parts * GROUP;
  s.end = r->end;
  return s;
}

__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void bin_tiles(
    __global const Item* items, __global const TopRange* ranges, __global const uint* tiles,
    __global uint* bins, __global const uint* counters, uint level, __local uint* own) {
  const uint lid = (uint)get_local_id(0), tile = (uint)get_group_id(0);
  // A group without work goes through all the same: PoCL 3.1 has trouble with barriers after a return.
  const bool works = tile < counters[LEVEL_WORDS * level + LEVEL_TILES];
  for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) own[i] = empty_bin_word(i);
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint at = works ? tiles[2u * tile] : 0u;
  if (works) {
    const TopRange r = ranges[at];
    const Spread s = tile_items(&r, tiles[2u * tile + 1u]);
    for (uint i = s.begin; i < s.end; i += s.step) fill_bins(own, &items[i], &r);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  volatile __global uint* to = bins + at * ALL_BIN_WORDS;
  for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) {
    if (own[i / BIN_WORDS * BIN_WORDS + 7u] == 0u) continue;
    const uint word = i % BIN_WORDS;
    if (word < 3u) atomic_min(&to[i], own[i]);
    else if (word < 6u) atomic_max(&to[i], own[i]);
    else atomic_add(&to[i], own[i]);
  }
}

// Moves the items of a tile to their range's sides: those on the left from the range's begin on, those on
// the right from its end down. What the sides hold goes to `sides`.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void move_tiles(
    __global const Item* items, __global Item* moved, __global const TopRange* ranges,
    __global const uint* tiles, __global const uint* bins, __global TopSides* sides,
    __global const uint* counters, uint level, __local uint* pool) {
  const uint lid = (uint)get_local_id(0), tile = (uint)get_group_id(0);
  const bool works = tile < counters[LEVEL_WORDS * level + LEVEL_TILES];
  const uint at = works ? tiles[2u * tile] : 0u;
  const TopRange r = ranges[at];
  for (uint i = lid; i < ALL_BIN_WORDS; i += GROUP) pool[i] = bins[at * ALL_BIN_WORDS + i];
  split_bins(pool, &r);
  __local uint* own = pool + SPLIT_SIDES;
  const bool is_by_index = pool[SPLIT_CHOICE] == SPLIT_BY_INDEX;
  Spread s = tile_items(&r, works ? tiles[2u * tile + 1u] : 0u);
  if (!works) s.end = s.begin;
  for (uint i = s.begin; i < s.end; i += s.step) {
    const uint side = side_of(pool, &items[i], &r);
    atomic_inc(&own[SIDES_COUNT + side]);
    if (is_by_index) grow_side(own, &items[i], side);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  if (works && lid < SIDES_COUNT + 2u) {
    volatile __global uint* all = (volatile __global uint*)(sides + at);
    if (lid < 6u) atomic_min(&all[lid], own[lid]);
    else if (lid < SIDES_COUNT) atomic_max(&all[lid], own[lid]);
    else pool[SPLIT_CHOICE + 2u + lid - SIDES_COUNT] = atomic_add(&all[lid], own[lid]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = s.begin; i < s.end; i += s.step) {
    const uint side = side_of(pool, &items[i], &r), place = atomic_inc(&pool[SPLIT_CHOICE + 2u + side]);
    moved[side == 0u ? r.begin + place : r.end - 1u - place] = items[i];
  }
}

__kernel void list_ranges(__global const Item* moved, __global const TopRange* ranges,
                          __global const TopSides* sides, __global TopRange* next_ranges,
                          __global uint* next_tiles, __global TopSides* next_sides, __global uint* next_bins,
                          __global TopRange* small, __global Node* nodes, __global const uint* refs,
                          __global uint* counters, uint level, uint is_tiled) {
  const uint at = (uint)get_global_id(0);
  if (at >= counters[LEVEL_WORDS * level + LEVEL_RANGES]) return;
  Lists to;
  to.ranges = next_ranges, to.tiles = is_tiled != 0u ? next_tiles : 0, to.sides = next_sides;
  to.bins = next_bins, to.small = small, to.nodes = nodes, to.refs = refs, to.counters = counters;
  list_sides(&to, ranges[at], sides[at], moved, (volatile __global uint*)(counters + LEVEL_WORDS * (level + 1u)));
}

// A group splits a range, however many items it has.
__kernel __attribute__((reqd_work_group_size(SPLIT_GROUP, 1, 1))) void split_ranges(
    __global const Item* items, __global Item* moved, __global const TopRange* ranges,
    __global TopRange* next_ranges, __global TopRange* small, __global Node* nodes,
    __global const uint* refs, __global uint* counters, uint level, __local uint* pool) {
  const uint lid = (uint)get_local_id(0), at = (uint)get_group_id(0);
  const bool works = at < counters[LEVEL_WORDS * level + LEVEL_RANGES];
  const TopRange r = ranges[works ? at : 0u];
  const uint begin = works ? r.begin : 0u, end = works ? r.end : 0u;
  for (uint i = lid; i < ALL_BIN_WORDS; i += SPLIT_GROUP) pool[i] = empty_bin_word(i);
  barrier(CLK_LOCAL_MEM_FENCE);
  // 32 neighbours in the group are far apart in the range, so that few meet at one bin.
  const uint stride = (end - begin + 31u) / 32u, first = begin + lid % 32u * stride;
  const uint last = min(first + stride, end);
  for (uint i = first + lid / 32u; i < last; i += SPLIT_GROUP / 32u) fill_bins(pool, &items[i], &r);
  split_bins(pool, &r);
  __local uint* sides = pool + SPLIT_SIDES;
  const bool is_by_index = pool[SPLIT_CHOICE] == SPLIT_BY_INDEX;
  for (uint i = first + lid / 32u; i < last; i += SPLIT_GROUP / 32u) {
    const uint side = side_of(pool, &items[i], &r), place = atomic_inc(&sides[SIDES_COUNT + side]);
    if (is_by_index) grow_side(sides, &items[i], side);
    moved[side == 0u ? begin + place : end - 1u - place] = items[i];
  }
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  if (!works || lid != 0u) return;
  Lists to;
  to.ranges = next_ranges, to.tiles = 0, to.sides = 0, to.bins = 0;
  to.small = small, to.nodes = nodes, to.refs = refs, to.counters = counters;
  TopSides s;
  for (uint i = 0u; i < 6u; ++i) {
    s.lo[i / 3u][i % 3u] = sides[i];
    s.hi[i / 3u][i % 3u] = sides[6u + i];
  }
  s.count[0] = sides[SIDES_COUNT], s.count[1] = sides[SIDES_COUNT + 1u];
  s.spare[0] = s.spare[1] = 0u;
  list_sides(&to, r, s, moved, (volatile __global uint*)(counters + LEVEL_WORDS * (level + 1u)));
}

// Trees over the small ranges, a group to each.
__kernel __attribute__((reqd_work_group_size(32, 1, 1))) void finish_ranges(
    __global const Item* even, __global const Item* odd, __global const TopRange* small, __global Node* nodes,
    __global const uint* refs, __global uint* counters, __local uint* pool) {
  const uint lane = (uint)get_local_id(0);
  const TopRange r = small[get_group_id(0)];
  const uint count = r.end - r.begin;
  __global const Item* items = (r.buffer == 0u ? even : odd) + r.begin;
  // In the order of their indices.
  pool[SWEEP_KEY + lane] = items[min(lane, count - 1u)].index;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint place = lane;
  if (lane < count) {
    place = 0u;
    for (uint i = 0u; i < count; ++i) place += pool[SWEEP_KEY + i] < pool[SWEEP_KEY + lane];
  }
  __global const Item* item = items + min(lane, count - 1u);
  put_sweep_box((__local float*)pool, place, item_bounds(item));
  pool[SWEEP_WEIGHT + place] = as_uint((float)FACET_SIZE_OF(item->size));
  pool[SWEEP_COST + place] = item->index;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint index = pool[SWEEP_COST + lane];
  barrier(CLK_LOCAL_MEM_FENCE);
  pool[SWEEP_COST + place] = FACET_HEIGHT_OF(item->size);
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint height = pool[SWEEP_COST + lane];
  const Swept t = sweep_tree(lane, count, r.node, pool);
  barrier(CLK_LOCAL_MEM_FENCE);
  pool[SWEEP_WEIGHT + lane] = height;
  pool[SWEEP_KEY + lane] = index;
  if (lane == 0u) pool[SWEEP_MASK] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lane < count) {
    pool[SWEEP_NODES + 16u * (t.link >> 1) + NODE_CHILD + (t.link & 1u)] = refs[pool[SWEEP_KEY + t.moved_from]];
    atomic_max(&pool[SWEEP_MASK], r.depth + t.depth + pool[SWEEP_WEIGHT + t.moved_from]);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = lane; i < 16u * t.nodes; i += 32u) {
    const uint word = i % 16u, value = pool[SWEEP_NODES + i];
    ((__global uint*)(nodes + r.node))[i] = word >= NODE_CHILD + 2u ? 0u : value;
  }
  if (lane == 0u) atomic_max((volatile __global uint*)&counters[TOTALS + 1u], pool[SWEEP_MASK]);
}
