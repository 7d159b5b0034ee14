// A stable LSD radix sort of keys with 32-bit values by digits of 8 bits, for devices whose work-groups
// share local memory: a pass a digit, in which each group ranks a tile of keys, learns where in
// the whole its keys of each digit begin, and writes them in runs (cl/tile_rank.h).
//
// FACET_LOOK_BACK: that place comes from the groups before it, while all run, so that a pass reads and
// writes each key once ("onesweep": Adinets and Merrill, 2022). All digits' counts were found
// by `histogram`. Without it the place was counted before: cl/radix_counts.cl.
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
// Words of local memory that `scatter` is given; host/tracer/group_sort.cpp has it too. They are an
// argument because PoCL 3.1 has some arrays of a kernel's own, if handed on to functions, once for all
// threads.
#define LOCAL_WORDS (POOL_WORDS + 256 + 2 * SCAN_SIZE)

#ifdef FACET_LOOK_BACK
// A histogram's counters are repeated, so that few work-items meet at one.
#ifndef COPIES
#define COPIES 1
#endif
#define PASSES (int)sizeof(KEY)

static inline void count_key(KEY key, __local uint* counts, uint bits) {
  UNROLL
  for (uint p = 0u; p < PASSES; ++p) {
    const uint shift = p * DIGIT_BITS;
    if (shift >= bits) break;
    const uint mask = (1u << min(bits - shift, DIGIT_BITS)) - 1u;
    atomic_inc(&counts[(p * DIGITS + digit_of(key, shift, mask)) * COPIES]);
  }
}

// bins[pass * DIGITS + digit] grows by how many keys have the digit, for all passes that `bits` lowest
// bits need. counts: PASSES * DIGITS * COPIES. Also makes the first pass's words and all passes' counters 0.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void histogram(
    __global const KEY* keys, __global uint* bins, __global uint* words, __global uint* counters,
    uint count, uint bits, __local uint* counts) {
  const uint lid = (uint)get_local_id(0), id = (uint)get_global_id(0), ids = (uint)get_global_size(0);
  for (uint i = lid; i < PASSES * DIGITS * COPIES; i += GROUP) counts[i] = 0u;
  const uint tiles = (count + TILE - 1u) / TILE;
  for (uint i = id; i < tiles * DIGITS; i += ids) words[i] = 0u;
  if (id < PASSES) counters[id] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  __local uint* own = counts + lid % COPIES;
  __global const uint4* fours = (__global const uint4*)keys;
  const uint in_four = 16u / (uint)sizeof(KEY), four_count = count / in_four;
  for (uint i = id; i < four_count; i += ids) {
    const uint4 four = fours[i];
    if (sizeof(KEY) == 4) {
      count_key((KEY)four.x, own, bits);
      count_key((KEY)four.y, own, bits);
      count_key((KEY)four.z, own, bits);
      count_key((KEY)four.w, own, bits);
    } else {
      count_key((KEY)as_ulong(four.xy), own, bits);
      count_key((KEY)as_ulong(four.zw), own, bits);
    }
  }
  if (id < count - four_count * in_four) count_key(keys[four_count * in_four + id], own, bits);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint i = lid; i < PASSES * DIGITS; i += GROUP) {
    uint sum = 0u;
    for (uint c = 0u; c < COPIES; ++c) sum += counts[i * COPIES + c];
    if (sum > 0u) atomic_add((volatile __global uint*)&bins[i], sum);
  }
}
#endif

// One pass, by the digit at bit `shift`. If `is_first_order` a value is its key's index, and `values`
// is not read. count < 2^30.
//
// By look-back: bins and counters are this pass's; bins are left 0, as the next sort needs them;
// words[tile * DIGITS + digit] are 0 before, and next_words, the next pass's, after.
// Otherwise: places[digit * tiles + tile].
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void scatter(
    __global const KEY* keys, __global const uint* values, __global KEY* keys_out,
    __global uint* values_out,
#ifdef FACET_LOOK_BACK
    __global uint* bins, __global uint* words, __global uint* next_words, __global uint* counters,
#else
    __global const uint* places,
#endif
    uint count, uint shift, uint mask, uint is_first_order, __local ulong* pool) {
  __local uint* counts = (__local uint*)pool;   // then keys, then values
  __local uint* place = counts + POOL_WORDS;    // where a digit's keys go, less their ranks in the tile
  __local ulong* sums = pool + (POOL_WORDS + 256) / 2;
  const uint lid = (uint)get_local_id(0);
  clear_counts(lid, counts);
#ifdef FACET_LOOK_BACK
  __local uint handed[1];
  if (lid == 0u) handed[0] = atomic_inc((volatile __global uint*)&counters[shift / DIGIT_BITS]);
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint tile = handed[0];
#else
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint tile = (uint)get_group_id(0);
#endif
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
  __global uint* pass_bins = bins + shift / DIGIT_BITS * DIGITS;
  // Tile 0 begins where the smaller digits of all tiles end; it publishes once it knows.
  const bool is_first = tile == 0u;
  const uint all = is_first && lid < DIGITS ? pass_bins[lid] : 0u;
  if (lid < DIGITS) {
    if (!is_first) share_word(&words[tile * DIGITS + lid], own | COUNT_OF_ONE);
    next_words[tile * DIGITS + lid] = 0u;
  }
  const ulong sum = sum_before(lid, (ulong)all << 32 | own, sums);
  const uint first = (uint)sum;
  uint before = (uint)(sum >> 32);  // keys that go before the tile's first of this digit
  if (is_first && lid < DIGITS) {
    share_word(&words[lid], before + own | COUNT_OF_ALL);
    pass_bins[lid] = 0u;
  }
#else
  const uint first = (uint)sum_before(lid, (ulong)own, sums);
#endif
  uint rank[ITEMS];
  rank_tile(lid, key, shift, mask, first, rank, counts, sums);
  barrier(CLK_LOCAL_MEM_FENCE);

  __local KEY* key_pool = (__local KEY*)pool;
#ifdef FACET_SORT_BESIDE
  __local uint* value_pool = (__local uint*)pool + KEY_WORDS;
#else
  __local uint* value_pool = (__local uint*)pool;
#endif
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) key_pool[rank[i]] = key[i];
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
  for (uint i = 0u; i < ITEMS; ++i) value_pool[rank[i]] = value[i];
#endif
  if (lid < DIGITS) {
#ifdef FACET_LOOK_BACK
    if (tile > 0u) {
      before = look_back(words + lid, tile, DIGITS, 0xffffffffu);
      share_word(&words[tile * DIGITS + lid], before + own | COUNT_OF_ALL);
    }
#else
    const uint before = places[(size_t)lid * get_num_groups(0) + tile];
#endif
    place[lid] = before - first;
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  uint to[ITEMS];
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint at = i * GROUP + lid;
    const KEY out = key_pool[at];
    to[i] = place[digit_of(out, shift, mask)] + at;
    if (at >= held) continue;
    keys_out[to[i]] = out;
#ifdef FACET_SORT_BESIDE
    values_out[to[i]] = value_pool[at];
#endif
  }
#ifndef FACET_SORT_BESIDE
  barrier(CLK_LOCAL_MEM_FENCE);
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) value_pool[rank[i]] = value[i];
  barrier(CLK_LOCAL_MEM_FENCE);
  UNROLL
  for (uint i = 0u; i < ITEMS; ++i) {
    const uint at = i * GROUP + lid;
    if (at < held) values_out[to[i]] = value_pool[at];
  }
#endif
}
