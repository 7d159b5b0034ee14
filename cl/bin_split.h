// The split of a range of items by a group: bins in local memory, the best of all splits between them,
// and which side an item goes to.
#ifndef FACET_BIN_SPLIT_H
#define FACET_BIN_SPLIT_H

#include "bins.h"
#include "ordered.h"

// A bin in memory: lo, hi as ordered integers, weight, items.
#define BIN_WORDS FACET_BIN_WORDS
#define ALL_BIN_WORDS FACET_ALL_BIN_WORDS

// Local memory, in words: the bins, then
#define SPLIT_COSTS ALL_BIN_WORDS               // one a candidate: bins below c % BINS of an axis go left
#define SPLIT_CHOICE (SPLIT_COSTS + 3u * BINS)  // axis, bin; where a tile's items of each side go
#define SPLIT_SIDES (SPLIT_CHOICE + 4u)         // as TopSides
#define SIDES_COUNT 12u
// FACET_SPLIT_WORDS in all

static inline uint empty_bin_word(uint i) { return i % BIN_WORDS < 3u ? ORDERED_MOST : ORDERED_LEAST; }

static inline void fill_bins(__local uint* bins, __global const Item* item, const TopRange* r) {
  const Bounds b = item_bounds(item);
  const float3 c = centre2(b);
  const uint at[3] = {bin_of(c.x, r->lo[0], r->hi[0]), bin_of(c.y, r->lo[1], r->hi[1]),
                      bin_of(c.z, r->lo[2], r->hi[2])};
  const uint lo[3] = {ordered(b.lo.x), ordered(b.lo.y), ordered(b.lo.z)};
  const uint hi[3] = {ordered(b.hi.x), ordered(b.hi.y), ordered(b.hi.z)};
  for (uint axis = 0u; axis < 3u; ++axis) {
    __local uint* bin = bins + (axis * BINS + at[axis]) * BIN_WORDS;
    for (uint k = 0u; k < 3u; ++k) {
      atomic_min(&bin[k], lo[k]);
      atomic_max(&bin[3u + k], hi[k]);
    }
    atomic_add(&bin[6], FACET_SIZE_OF(item->size));
    atomic_add(&bin[7], 1u);
  }
}

static inline Bounds unordered_bounds(const uint* lo, const uint* hi) {
  Bounds b;
  b.lo = (float3)(unordered(lo[0]), unordered(lo[1]), unordered(lo[2]));
  b.hi = (float3)(unordered(hi[0]), unordered(hi[1]), unordered(hi[2]));
  return b;
}

typedef struct {
  uint lo[3], hi[3];
  uint weight, items;
} BinSum;

static inline BinSum sum_bins(__local const uint* bins, uint axis, uint begin, uint end) {
  BinSum s;
  for (uint a = 0u; a < 3u; ++a) s.lo[a] = ORDERED_MOST, s.hi[a] = ORDERED_LEAST;
  s.weight = s.items = 0u;
  for (uint k = begin; k < end; ++k) {
    __local const uint* bin = bins + (axis * BINS + k) * BIN_WORDS;
    for (uint a = 0u; a < 3u; ++a) {
      s.lo[a] = min(s.lo[a], bin[a]);
      s.hi[a] = max(s.hi[a], bin[3u + a]);
    }
    s.weight += bin[6];
    s.items += bin[7];
  }
  return s;
}

// What each split between the bins costs.
static inline void find_costs(__local uint* pool, const TopRange* r) {
  const uint c = (uint)get_local_id(0);
  if (c >= 3u * BINS) return;
  const BinSum left = sum_bins(pool, c / BINS, 0u, c % BINS), right = sum_bins(pool, c / BINS, c % BINS, BINS);
  const bool is_split = left.items != 0u && right.items != 0u && r->depth < TOP_SWEPT_DEPTH;
  pool[SPLIT_COSTS + c] = as_uint(
      is_split ? split_cost(unordered_bounds(left.lo, left.hi), (float)left.weight,
                            unordered_bounds(right.lo, right.hi), (float)right.weight)
               : INFINITY);
}

// The best split, of those that cost the same the first: pool[SPLIT_CHOICE ..]. Makes pool[SPLIT_SIDES ..]
// that of the two sides, but for the counts, which are 0, and for the bounds of a split by index, which
// hold nothing.
static inline void choose_split(__local uint* pool, const TopRange* r) {
  const uint side = (uint)get_local_id(0);
  if (side >= 2u) return;
  uint best = 0u;
  for (uint c = 1u; c < 3u * BINS; ++c)
    if (as_float(pool[SPLIT_COSTS + c]) < as_float(pool[SPLIT_COSTS + best])) best = c;
  const bool is_by_bins = as_float(pool[SPLIT_COSTS + best]) < INFINITY;
  const uint axis = best / BINS, bin = best % BINS;
  if (side == 0u) {
    pool[SPLIT_CHOICE] = is_by_bins ? axis : SPLIT_BY_INDEX;
    pool[SPLIT_CHOICE + 1u] = is_by_bins ? bin : middle_index(r->first, r->last);
  }
  __local uint* sides = pool + SPLIT_SIDES;
  const BinSum sum = sum_bins(pool, axis, side == 0u ? 0u : bin, side == 0u ? bin : BINS);
  for (uint a = 0u; a < 3u; ++a) {
    sides[3u * side + a] = is_by_bins ? sum.lo[a] : ORDERED_MOST;
    sides[6u + 3u * side + a] = is_by_bins ? sum.hi[a] : ORDERED_LEAST;
  }
  sides[SIDES_COUNT + side] = 0u;
}

// Both, of bins that are full; all work-items of the group call it together.
static inline void split_bins(__local uint* pool, const TopRange* r) {
  barrier(CLK_LOCAL_MEM_FENCE);
  find_costs(pool, r);
  barrier(CLK_LOCAL_MEM_FENCE);
  choose_split(pool, r);
  barrier(CLK_LOCAL_MEM_FENCE);
}

static inline uint side_of(__local const uint* pool, __global const Item* item, const TopRange* r) {
  const uint axis = pool[SPLIT_CHOICE], bin = pool[SPLIT_CHOICE + 1u];
  if (axis == SPLIT_BY_INDEX) return item->index <= bin ? 0u : 1u;
  return bin_of(item->lo[axis] + item->hi[axis], r->lo[axis], r->hi[axis]) < bin ? 0u : 1u;
}

// For a split by index, of which no bins tell the sides' bounds.
static inline void grow_side(__local uint* sides, __global const Item* item, uint side) {
  for (uint a = 0u; a < 3u; ++a) {
    atomic_min(&sides[3u * side + a], ordered(item->lo[a]));
    atomic_max(&sides[6u + 3u * side + a], ordered(item->hi[a]));
  }
}

#endif
