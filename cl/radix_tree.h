// The radix tree over sorted codes (Karras, "Maximizing parallelism in the construction of BVHs, octrees,
// and k-d trees", 2012): neighbours part at the highest bit that differs, of the code and then of the place, so
// that equal codes have a tree, too. It is no deeper than 32 + ceil(log2 n).
//
// Of the boundaries next to a subtree its parent is at the one whose sides have more in common. The two never
// have as much: at that bit the place before the subtree has a 0 and its first a 1, and its last a 0.
#ifndef FACET_RADIX_TREE_H
#define FACET_RADIX_TREE_H

#include "build_layout.h"

// How many leading bits place i has in common with place i + 1, and 1: larger where they part later; 0
// where there is no neighbour. At most 64.
static inline uint common_bits(__global const uint* codes, uint count, uint i) {
  if (i >= count - 1u) return 0u;  // also i = 0 - 1
  const uint difference = codes[i] ^ codes[i + 1u];
  return 1u + (difference != 0u ? clz(difference) : 32u + clz(i ^ (i + 1u)));
}

#endif
