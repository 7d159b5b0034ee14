// A stable LSD radix sort of keys with 32-bit values by digits of 8 bits, for devices whose work-groups
// share local memory: a pass a digit, in which each group sorts a tile of keys (cl/radix_tile.h).
//
// FACET_LOOK_BACK: where a tile's keys go is learned from the groups before it, while all run, so that a
// pass reads and writes each key once ("onesweep": Adinets and Merrill, 2022). All digits' counts were
// found before, by a histogram. Without it the places were counted before: cl/radix_counts.cl.
//
// FACET_ONE_LAUNCH: all of that in one launch; FACET_MANY_LAUNCHES: that, too.
#include "radix_tile.h"
#ifdef FACET_LOOK_BACK
#include "radix_histogram.h"
#endif

#ifdef FACET_ONE_LAUNCH
// A sort's items in order: `parts` of the histogram, then each pass's tiles. A group does one, and gets it from
// a counter as it starts: what it waits for has then been started before. That is all look-back asks for,
// too; but here groups also read what others wrote, by share_fence.
//
// state: words that groups meet at, far apart, all 0 before and after: items handed out; of each stage (the
// histogram, then the passes), items done.
#define STATE_STRIDE 32u
#define HANDED 0u
#define DONE(stage) (((stage) + 1u) * STATE_STRIDE)

// Pass p sorts from a to b if it is even, otherwise from b to a; words likewise.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void sort_whole(
    __global KEY* keys_a, __global uint* values_a, __global KEY* keys_b, __global uint* values_b,
    __global uint* bins, __global uint* words_a, __global uint* words_b, __global uint* state,
    uint count, uint bits, uint is_first_order, uint parts, __local ulong* pool) {
  __local uint handed[1];
  const uint lid = (uint)get_local_id(0);
  const uint tiles = (count + TILE - 1u) / TILE, passes = (bits + DIGIT_BITS - 1u) / DIGIT_BITS;
  if (lid == 0u) handed[0] = atomic_inc((volatile __global uint*)&state[HANDED]);
  clear_counts(lid, (__local uint*)pool);
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint item = handed[0];
  const uint stage = item < parts ? 0u : 1u + (item - parts) / tiles;
  if (stage == 0u) {
    count_part(lid, item, parts, keys_a, bins, words_a, count, bits, (__local uint*)pool);
  } else {
    const uint pass = stage - 1u, tile = (item - parts) % tiles, shift = pass * DIGIT_BITS;
    const uint before = pass == 0u ? parts : tiles;
    if (lid == 0u) {
      while (shared_word(&state[DONE(stage - 1u)]) != before) {
      }
      share_fence();
    }
    barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
    const bool is_even = pass % 2u == 0u;
    sort_tile(lid, tile, is_even ? keys_a : keys_b, is_even ? values_a : values_b,
              is_even ? keys_b : keys_a, is_even ? values_b : values_a, bins + pass * DIGITS,
              is_even ? words_a : words_b, is_even ? words_b : words_a, count, shift,
              (1u << min(bits - shift, DIGIT_BITS)) - 1u, pass == 0u ? is_first_order : 0u, pool);
  }
  barrier(CLK_LOCAL_MEM_FENCE | CLK_GLOBAL_MEM_FENCE);
  if (lid > 0u) return;
  share_fence();
  const uint done = atomic_inc((volatile __global uint*)&state[DONE(stage)]) + 1u;
  if (stage < passes || done < tiles) return;
  state[HANDED] = 0u;
  for (uint s = 0u; s <= passes; ++s) state[DONE(s)] = 0u;
}

#endif

#if !defined(FACET_ONE_LAUNCH) || defined(FACET_MANY_LAUNCHES)
#ifdef FACET_LOOK_BACK
// Counts all digits. Also makes the first pass's words and all passes' counters 0.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void histogram(
    __global const KEY* keys, __global uint* bins, __global uint* words, __global uint* counters,
    uint count, uint bits, __local uint* counts) {
  const uint id = (uint)get_global_id(0);
  if (id < PASSES) counters[id] = 0u;
  count_part((uint)get_local_id(0), (uint)get_group_id(0), (uint)get_num_groups(0), keys, bins, words, count,
             bits, counts);
}
#endif

// One pass, by the digit at bit `shift`. bins and counters are all passes', words and next_words this pass's
// and the next one's (sort_tile).
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void scatter(
    __global const KEY* keys, __global const uint* values, __global KEY* keys_out,
    __global uint* values_out,
#ifdef FACET_LOOK_BACK
    __global uint* bins, __global uint* words, __global uint* next_words, __global uint* counters,
#else
    __global const uint* places,
#endif
    uint count, uint shift, uint mask, uint is_first_order, __local ulong* pool) {
  const uint lid = (uint)get_local_id(0);
  clear_counts(lid, (__local uint*)pool);
#ifdef FACET_LOOK_BACK
  __local uint handed[1];
  if (lid == 0u) handed[0] = atomic_inc((volatile __global uint*)&counters[shift / DIGIT_BITS]);
  barrier(CLK_LOCAL_MEM_FENCE);
  sort_tile(lid, handed[0], keys, values, keys_out, values_out, bins + shift / DIGIT_BITS * DIGITS, words,
            next_words, count, shift, mask, is_first_order, pool);
#else
  barrier(CLK_LOCAL_MEM_FENCE);
  sort_tile(lid, (uint)get_group_id(0), keys, values, keys_out, values_out, places, (uint)get_num_groups(0),
            count, shift, mask, is_first_order, pool);
#endif
}

#endif
