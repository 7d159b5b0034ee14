// The binary tree that sorted codes imply (Karras, "Maximizing parallelism in the construction of
// BVHs, octrees, and k-d trees", 2012): neighbours are parted at the highest bit that differs, of the
// code and then of the place, so that equal codes have a tree, too.
#ifndef FACET_RADIX_TREE_H
#define FACET_RADIX_TREE_H

// How many leading bits place i has in common with place i + 1: larger where they part later. -1 at
// the ends. At most 32 + 31.
static inline int common_bits(__global const uint* codes, uint count, uint i) {
  if (i >= count - 1u) return -1;  // also i = 0 - 1
  const uint difference = codes[i] ^ codes[i + 1u];
  return difference != 0u ? (int)clz(difference) : 32 + (int)clz(i ^ (i + 1u));
}

// Whether one of the largest subtrees of at most `most` places begins at place i.
static inline bool begins_subtree(__global const uint* codes, uint count, uint i, uint most) {
  uint end = i;  // i .. end is a subtree
  for (;;) {
    const int before = common_bits(codes, count, i - 1u), after = common_bits(codes, count, end);
    const int most_common = max(before, after);
    if (most_common < 0) return true;
    // Its parent has all neighbours that have as much in common.
    uint parent_end = end, parent_begin = i;
    while (parent_end - parent_begin < most && common_bits(codes, count, parent_end) >= most_common)
      ++parent_end;
    while (parent_end - parent_begin < most && common_bits(codes, count, parent_begin - 1u) >= most_common)
      --parent_begin;
    if (parent_end - parent_begin >= most) return true;
    if (parent_begin < i) return false;
    end = parent_end;
  }
}

#endif
