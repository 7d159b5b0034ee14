// Running sums over work-groups in one pass: decoupled look-back (Merrill and Garland, "Single-pass
// parallel prefix scan with decoupled look-back", 2016). A group publishes its own sum, then adds up
// what the groups before it published until it meets one that knows the sum of all before.
//
// It ends only if groups get their ids from a counter as they start, so that all before have started,
// and if what has started goes on to run and its words are seen meanwhile. host/tracer/look_back.hpp
// proves that of a device.
#ifndef FACET_LOOK_BACK_H
#define FACET_LOOK_BACK_H
#include "warp.h"

// A word is 0 until it is published: a count below 2^30, and above it what is counted.
#define COUNT_OF_ONE (1u << 30)  // the group's own
#define COUNT_OF_ALL (2u << 30)  // the group's and those of all before it
#define COUNT_BITS (COUNT_OF_ONE - 1u)

// Words that are asked for at once: a step takes the time of one answer, however many there are.
#ifndef FACET_LOOK_BACK_WINDOW
#define FACET_LOOK_BACK_WINDOW 4
#endif
#define LOOK_BACK_FAILED 0xffffffffu

// The sum over all groups g before `group` > 0 of words[g * stride]; group 0's word is a count of all.
// LOOK_BACK_FAILED after `steps` steps.
static inline uint look_back(__global uint* words, uint group, uint stride, uint steps) {
  uint sum = 0u;
  uint next = group;  // from here on all are in the sum
  for (; steps > 0u; --steps) {
    uint seen[FACET_LOOK_BACK_WINDOW];
    UNROLL
    for (uint i = 0u; i < FACET_LOOK_BACK_WINDOW; ++i)
      seen[i] = next > i ? shared_word(&words[(size_t)(next - 1u - i) * stride]) : 0u;
    bool is_whole = true;
    UNROLL
    for (uint i = 0u; i < FACET_LOOK_BACK_WINDOW; ++i) {
      is_whole = is_whole && seen[i] != 0u;
      if (!is_whole) continue;
      sum += seen[i] & COUNT_BITS;
      if (seen[i] & COUNT_OF_ALL) return sum;
      --next;
    }
  }
  return LOOK_BACK_FAILED;
}

#endif
