// How many keys have each digit, for all passes of a radix sort at once. All work-items of a group call
// this together, and several groups share the keys.
#ifndef FACET_RADIX_HISTOGRAM_H
#define FACET_RADIX_HISTOGRAM_H
#include "radix_digit.h"
#include "warp.h"

// A histogram's counters are repeated, so that few work-items meet at one.
#ifndef COPIES
#define COPIES 1
#endif
#define PASSES (int)sizeof(KEY)
#define HISTOGRAM_WORDS (PASSES * 256 * COPIES)
// Loads that are under way at once.
#define LOADS 4u

static inline void count_key(KEY key, __local uint* counts, uint bits) {
  UNROLL
  for (uint p = 0u; p < PASSES; ++p) {
    const uint shift = p * DIGIT_BITS;
    if (shift >= bits) break;
    const uint mask = (1u << min(bits - shift, DIGIT_BITS)) - 1u;
    atomic_inc(&counts[(p * DIGITS + digit_of(key, shift, mask)) * COPIES]);
  }
}

static inline void count_four(uint4 four, __local uint* counts, uint bits) {
  if (sizeof(KEY) == 4) {
    count_key((KEY)four.x, counts, bits);
    count_key((KEY)four.y, counts, bits);
    count_key((KEY)four.z, counts, bits);
    count_key((KEY)four.w, counts, bits);
  } else {
    count_key((KEY)as_ulong(four.xy), counts, bits);
    count_key((KEY)as_ulong(four.zw), counts, bits);
  }
}

// bins[pass * DIGITS + digit] grows by how many keys of this group's part have the digit, for all passes that
// `bits` lowest bits need. counts: HISTOGRAM_WORDS. Also makes the part's share of the first pass's words 0.
static inline void count_part(uint lid, uint part, uint parts, __global const KEY* keys, __global uint* bins,
                              __global uint* words, uint count, uint bits, __local uint* counts) {
  const uint id = part * GROUP + lid, ids = parts * GROUP;
  for (uint i = lid; i < HISTOGRAM_WORDS; i += GROUP) counts[i] = 0u;
  const uint tiles = (count + TILE - 1u) / TILE;
  for (uint i = id; i < tiles * DIGITS; i += ids) words[i] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  __local uint* own = counts + lid % COPIES;
  __global const uint4* fours = (__global const uint4*)keys;
  const uint in_four = 16u / (uint)sizeof(KEY), four_count = count / in_four;
  uint i = id;
  for (; i + (LOADS - 1u) * ids < four_count; i += LOADS * ids) {
    uint4 four[LOADS];
    UNROLL
    for (uint k = 0u; k < LOADS; ++k) four[k] = fours[i + k * ids];
    UNROLL
    for (uint k = 0u; k < LOADS; ++k) count_four(four[k], own, bits);
  }
  for (; i < four_count; i += ids) count_four(fours[i], own, bits);
  if (id < count - four_count * in_four) count_key(keys[four_count * in_four + id], own, bits);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint at = lid; at < PASSES * DIGITS; at += GROUP) {
    uint sum = 0u;
    for (uint c = 0u; c < COPIES; ++c) sum += counts[at * COPIES + c];
    if (sum > 0u) atomic_add((volatile __global uint*)&bins[at], sum);
  }
}

#endif
