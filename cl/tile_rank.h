// Where each key of a tile belongs among the tile's keys by one digit, stable. All work-items of the
// group call these together.
//
// FACET_PTX: a warp counts for itself, lane after lane and item after item, by who else in the warp
// has the same digit (Adinets and Merrill, "Onesweep: a faster least significant digit radix sort for
// GPUs", 2022). Without it: two stable splits by 4 bits, with counters packed into a work-item's
// registers (after Satish, Harris and Garland, "Designing efficient sorting algorithms for manycore
// GPUs", 2009).
#ifndef FACET_TILE_RANK_H
#define FACET_TILE_RANK_H
#include "radix_digit.h"
#include "warp.h"

// A work-item's ranks, two to a word: registers are what limits how many groups run at once.
#define RANK_PAIRS ((ITEMS + 1) / 2)
#if TILE > 65536
#error "a tile has at most 65536 keys"
#endif
static inline uint rank_of(const uint* ranks, uint i) {
  return i % 2u == 0u ? ranks[i / 2u] & 0xffffu : ranks[i / 2u] >> 16;
}
// Item by item, in order.
static inline void add_rank(uint* ranks, uint i, uint rank) {
  if (i % 2u == 0u)
    ranks[i / 2u] = rank;
  else
    ranks[i / 2u] |= rank << 16;
}

#ifdef FACET_PTX

#define WARPS (GROUP / 32)
#define SCAN_SIZE WARPS
// Words of local memory that ranking needs.
#define RANK_WORDS (WARPS * 256)

// Where in the tile the work-item's item i is: 32 in a row are one warp's.
static inline uint item_place(uint lid, uint i) {
  return lid / WARP_SIZE * (WARP_SIZE * ITEMS) + i * WARP_SIZE + lid % WARP_SIZE;
}

// The sum of what the work-items before this one give. A barrier must stand between two calls.
static inline ulong sum_before(uint lid, ulong value, __local ulong* sums) {
  const uint warp = lid / WARP_SIZE;
  const ulong up_to = warp_sum_up_to(lid, value);
  if (warp_lane(lid) == WARP_SIZE - 1u) sums[warp] = up_to;
  barrier(CLK_LOCAL_MEM_FENCE);
  ulong before = up_to - value;
  UNROLL
  for (uint w = 0u; w < WARPS; ++w) before += w < warp ? sums[w] : 0ul;
  return before;
}

static inline void clear_counts(uint lid, __local uint* counts) {
  for (uint i = lid; i < RANK_WORDS; i += GROUP) counts[i] = 0u;
}

// How many of the tile's keys have the digit that is the work-item's local id; counts are cleared.
static inline uint count_tile(uint lid, const KEY* key, uint shift, uint mask,
                              __local uint* counts) {
  __local uint* own = counts + lid / WARP_SIZE * DIGITS;
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) atomic_inc(&own[digit_of(key[i], shift, mask)]);
  barrier(CLK_LOCAL_MEM_FENCE);
  uint total = 0u;
  if (lid < DIGITS) {
    UNROLL
    for (uint w = 0u; w < WARPS; ++w) total += counts[w * DIGITS + lid];
  }
  return total;
}

// `first`: the rank of the tile's first key whose digit is the work-item's local id. After a barrier
// `counts` and `sums` are free.
static inline void rank_tile(uint lid, const KEY* key, uint shift, uint mask, uint first,
                             uint* ranks, __local uint* counts, __local ulong* sums) {
  if (lid < DIGITS) {
    UNROLL
    for (uint w = 0u; w < WARPS; ++w) {
      const uint here = counts[w * DIGITS + lid];
      counts[w * DIGITS + lid] = first;
      first += here;
    }
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  __local uint* next = counts + lid / WARP_SIZE * DIGITS;
  const uint below = lanes_below(warp_lane(lid));
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint digit = digit_of(key[i], shift, mask);
    const uint equal = warp_equal(digit);
    const uint leader = highest_lane(equal);
    uint from = 0u;
    if (warp_lane(lid) == leader) from = atomic_add(&next[digit], popcount(equal));
    add_rank(ranks, i, warp_from(from, leader) + popcount(equal & below));
  }
}

#else

#define SCAN_SIZE GROUP
#define SPLIT_WORDS (16 * GROUP)
#define RANK_WORDS (SPLIT_WORDS > TILE ? SPLIT_WORDS : TILE)

static inline uint item_place(uint lid, uint i) { return i * GROUP + lid; }

static inline ulong sum_before(uint lid, ulong value, __local ulong* sums) {
  sums[lid] = value;
  barrier(CLK_LOCAL_MEM_FENCE);
  ulong up_to = value;
  for (uint step = 1u; step < GROUP; step *= 2u) {
    up_to += lid >= step ? sums[lid - step] : 0ul;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[lid] = up_to;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  return up_to - value;
}

static inline void clear_counts(uint lid, __local uint* counts) {
  for (uint i = lid; i < DIGITS; i += GROUP) counts[i] = 0u;
}

static inline uint count_tile(uint lid, const KEY* key, uint shift, uint mask,
                              __local uint* counts) {
  for (uint i = 0u; i < ITEMS; ++i) atomic_inc(&counts[digit_of(key[i], shift, mask)]);
  barrier(CLK_LOCAL_MEM_FENCE);
  return lid < DIGITS ? counts[lid] : 0u;
}

// Ranks of all work-items' held[0], held[1], ... in a row by their 4 bits at `shift`.
static inline void rank_by_4_bits(uint lid, const uint* held, uint shift, uint* rank,
                                  __local uint* counts, __local ulong* sums) {
  ulong low = 0ul, high = 0ul;  // 8 counters of 8 bits in each
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint digit = held[i] >> shift & 15u, at = (digit & 7u) * 8u;
    rank[i] = (uint)((digit < 8u ? low : high) >> at) & 255u;
    if (digit < 8u)
      low += 1ul << at;
    else
      high += 1ul << at;
  }
  for (uint d = 0u; d < 8u; ++d) {
    counts[d * GROUP + lid] = (uint)(low >> d * 8u) & 255u;
    counts[(d + 8u) * GROUP + lid] = (uint)(high >> d * 8u) & 255u;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  uint sum = 0u;
  for (uint k = 0u; k < 16u; ++k) sum += counts[lid * 16u + k];
  uint before = (uint)sum_before(lid, sum, sums);
  for (uint k = 0u; k < 16u; ++k) {
    const uint here = counts[lid * 16u + k];
    counts[lid * 16u + k] = before;
    before += here;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0u; i < ITEMS; ++i) rank[i] += counts[(held[i] >> shift & 15u) * GROUP + lid];
  barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void hand_over(uint lid, uint* held, __local uint* pool) {
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0u; i < ITEMS; ++i) held[i] = pool[lid * ITEMS + i];
  barrier(CLK_LOCAL_MEM_FENCE);
}

static inline void rank_tile(uint lid, const KEY* key, uint shift, uint mask, uint first,
                             uint* ranks, __local uint* pool, __local ulong* sums) {
  uint rank[ITEMS];
  uint held[ITEMS];  // a digit, and above it where its key is in the tile
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0u; i < ITEMS; ++i)
    pool[item_place(lid, i)] = digit_of(key[i], shift, mask) | item_place(lid, i) << DIGIT_BITS;
  hand_over(lid, held, pool);
  rank_by_4_bits(lid, held, 0u, rank, pool, sums);
  for (uint i = 0u; i < ITEMS; ++i) pool[rank[i]] = held[i];
  hand_over(lid, held, pool);
  rank_by_4_bits(lid, held, 4u, rank, pool, sums);
  for (uint i = 0u; i < ITEMS; ++i) pool[held[i] >> DIGIT_BITS] = rank[i];
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = 0u; i < ITEMS; ++i) add_rank(ranks, i, pool[item_place(lid, i)]);
}

#endif
#endif
