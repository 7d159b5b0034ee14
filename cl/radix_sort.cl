// A stable LSD radix sort of keys with 32-bit values by digits of 8 bits, for devices whose work-groups
// share local memory: a pass a digit, in which each group sorts a tile of keys (cl/radix_tile.h).
//
// FACET_LOOK_BACK: where a tile's keys go is learned from the groups before it, while all run, so that a
// pass reads and writes each key once ("onesweep": Adinets and Merrill, 2022). All digits' counts were
// found before, by a histogram. Without it the places were counted before: cl/radix_counts.cl.
#include "radix_tile.h"
#ifdef FACET_LOOK_BACK
#include "radix_histogram.h"
#endif

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
