// The largest subtrees of the radix tree that have at most MOST places, met in order.
#ifndef FACET_BEGUN_SUBTREE_H
#define FACET_BEGUN_SUBTREE_H

#include "radix_tree.h"

#define MOST FACET_SWEEP_MOST

// How many places the subtree has that begins at a place, 0 if none does. common[k] is of the
// place k - 1 further.
static inline uint begun_subtree(const uchar* common) {
  uint size = 1u;  // the first places from here on are a subtree
  for (;;) {
    const uint before = common[0], after = common[size];
    if (before == 0u && after == 0u) return size;
    // Its parent has all neighbours that have as much in common.
    if (before >= after) {
      uint more = 1u;
      while (size + more <= MOST && common[-(int)more] >= before) ++more;
      return size + more > MOST ? size : 0u;
    }
    uint parent = size + 1u;
    while (parent <= MOST && common[parent] >= after) ++parent;
    if (parent > MOST) return size;
    size = parent;
  }
}

#endif
