// A tile's way through one pass of a radix sort: its keys are ranked (cl/tile_rank.h), it learns where in
// the whole those of each digit begin, and they are written in runs.
#ifndef FACET_RADIX_TILE_H
#define FACET_RADIX_TILE_H
#include "tile_rank.h"
#ifdef FACET_LOOK_BACK
#include "look_back.h"
#endif

// FACET_SORT_BESIDE: values wait in local memory beside the keys, and go out with them.
#define KEY_WORDS (TILE * (int)sizeof(KEY) / 4)
#ifdef FACET_SORT_BESIDE
#define TILE_WORDS (KEY_WORDS + TILE)
#else
#define TILE_WORDS KEY_WORDS
#endif
#define POOL_WORDS (TILE_WORDS > RANK_WORDS ? TILE_WORDS : RANK_WORDS)
// Words of local memory that a tile needs; host/tracer/group_sort.cpp has it too. They are a kernel's
// argument because PoCL 3.1 has some arrays of a kernel's own, if handed on to functions, once for all
// threads.
#define LOCAL_WORDS (POOL_WORDS + 256 + 2 * SCAN_SIZE)

// Digits of the keys that a work-item writes, four to a word.
#define DIGIT_FOURS ((ITEMS + 3) / 4)

// One pass's work on a tile, by the digit at bit `shift`. If `is_first_order` a value is its key's index,
// and `values` is not read. count < 2^30. The pool's first RANK_WORDS words are cleared before
// (clear_counts), and a barrier has passed.
//
// By look-back: bins are this pass's, and left 0, as the next sort needs them; words[tile * DIGITS + digit]
// are 0 before the pass, and next_words, the next pass's, after.
// Otherwise: places[digit * tiles + tile].
static inline void sort_tile(
    uint lid, uint tile, __global const KEY* keys, __global const uint* values, __global KEY* keys_out,
    __global uint* values_out,
#ifdef FACET_LOOK_BACK
    __global uint* bins, __global uint* words, __global uint* next_words,
#else
    __global const uint* places, uint tiles,
#endif
    uint count, uint shift, uint mask, uint is_first_order, __local ulong* pool) {
  __local uint* counts = (__local uint*)pool;   // then keys, then values
  __local uint* place = counts + POOL_WORDS;    // where a digit's keys go, less their ranks in the tile
  __local ulong* sums = pool + (POOL_WORDS + 256) / 2;
  const uint base = tile * TILE, held = min(count - base, (uint)TILE);

  // What fills up the last tile sorts behind all its keys, and no tile comes after it.
  KEY key[ITEMS];
  if (held == TILE) {
    UNROLL
    for (uint i = 0u; i < ITEMS; ++i) key[i] = keys[base + item_place(lid, i)];
  } else {
    UNROLL
    for (uint i = 0u; i < ITEMS; ++i)
      key[i] = item_place(lid, i) < held ? keys[base + item_place(lid, i)] : ~(KEY)0;
  }
  const uint own = count_tile(lid, key, shift, mask, counts);
#ifdef FACET_LOOK_BACK
  // Tile 0 begins where the smaller digits of all tiles end; it publishes once it knows.
  const bool is_first = tile == 0u;
  const uint all = is_first && lid < DIGITS ? bins[lid] : 0u;
  if (lid < DIGITS) {
    if (!is_first) share_word(&words[tile * DIGITS + lid], own | COUNT_OF_ONE);
    next_words[tile * DIGITS + lid] = 0u;
  }
  const ulong sum = sum_before(lid, (ulong)all << 32 | own, sums);
  const uint first = (uint)sum;
  uint before = (uint)(sum >> 32);  // keys that go before the tile's first of this digit
  if (is_first && lid < DIGITS) {
    share_word(&words[lid], before + own | COUNT_OF_ALL);
    bins[lid] = 0u;
  }
#else
  const uint first = (uint)sum_before(lid, (ulong)own, sums);
#endif
  uint ranks[RANK_PAIRS];
  rank_tile(lid, key, shift, mask, first, ranks, counts, sums);
  barrier(CLK_LOCAL_MEM_FENCE);

  __local KEY* key_pool = (__local KEY*)pool;
#ifdef FACET_SORT_BESIDE
  __local uint* value_pool = (__local uint*)pool + KEY_WORDS;
#else
  __local uint* value_pool = (__local uint*)pool;
#endif
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) key_pool[rank_of(ranks, i)] = key[i];
  uint value[ITEMS];
  if (is_first_order) {
    UNROLL
    for (uint i = 0u; i < ITEMS; ++i) value[i] = base + item_place(lid, i);
  } else if (held == TILE) {
    UNROLL
    for (uint i = 0u; i < ITEMS; ++i) value[i] = values[base + item_place(lid, i)];
  } else {
    UNROLL
    for (uint i = 0u; i < ITEMS; ++i)
      value[i] = item_place(lid, i) < held ? values[base + item_place(lid, i)] : 0u;
  }
#ifdef FACET_SORT_BESIDE
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) value_pool[rank_of(ranks, i)] = value[i];
#endif
  if (lid < DIGITS) {
#ifdef FACET_LOOK_BACK
    if (!is_first) {
      before = look_back(words + lid, tile, DIGITS, 0xffffffffu);
      share_word(&words[tile * DIGITS + lid], before + own | COUNT_OF_ALL);
    }
#else
    const uint before = places[(size_t)lid * tiles + tile];
#endif
    place[lid] = before - first;
  }
  barrier(CLK_LOCAL_MEM_FENCE);

#ifndef FACET_SORT_BESIDE
  uint digits[DIGIT_FOURS];
#endif
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint at = i * GROUP + lid;
    const KEY out = key_pool[at];
    const uint digit = digit_of(out, shift, mask), to = place[digit] + at;
#ifdef FACET_SORT_BESIDE
    if (at < held) values_out[to] = value_pool[at];
#else
    digits[i / 4u] = i % 4u == 0u ? digit : digits[i / 4u] | digit << i % 4u * DIGIT_BITS;
#endif
    if (at < held) keys_out[to] = out;
  }
#ifndef FACET_SORT_BESIDE
  barrier(CLK_LOCAL_MEM_FENCE);
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) value_pool[rank_of(ranks, i)] = value[i];
  barrier(CLK_LOCAL_MEM_FENCE);
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint at = i * GROUP + lid;
    const uint digit = digits[i / 4u] >> i % 4u * DIGIT_BITS & DIGITS - 1u;
    if (at < held) values_out[place[digit] + at] = value_pool[at];
  }
#endif
}

#endif
