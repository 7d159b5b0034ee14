// Splits of many items by the surface area heuristic over bins (Wald, "On fast construction of SAH-based
// bounding volume hierarchies", 2007).
#ifndef FACET_BINS_H
#define FACET_BINS_H

#include "bounds.h"

#define BINS FACET_BINS

// Deeper ranges are halved by their items' indices: that ends after as many levels as an index has bits.
#define TOP_SWEPT_DEPTH 48u

// Bins lie between lo and hi, where doubled centres are or nearly are; without extent, or beyond what
// a float can hold, all is in bin 0.
static inline uint bin_of(float centre, float lo, float hi) {
  const float at = (centre - lo) / (hi - lo) * (float)BINS;
  return (uint)smaller(larger(at, 0.0f), (float)(BINS - 1u));
}

// Where no split by bins parts a range at a finite cost: items whose index is at most the middle one of
// those that it may have go left. All may go one way: then the range is as before, but for its indices.
#define SPLIT_BY_INDEX 3u  // as an axis
static inline uint middle_index(uint first, uint last) { return first + (last - first) / 2u; }

#endif
