// What a tree over few primitives is built from, by one work-item of a CPU: what the kernels of morton.cl,
// radix_buckets.cl and subtrees.cl make one after the other, and the same. A CPU's driver takes longer to compile these
// than they run.
#include "begun_subtree.h"
#include "bucket_sort.h"
#include "morton.h"

// Places that are looked at together.
#define STRETCH 1024u

// starts[k]: where subtree k begins, and ends, of total[0]; as subtrees.cl has them.
static inline void list_few(__global const uint* codes, uint count, __global uint* starts, __global uint* total) {
  uchar common[STRETCH + 2u * MOST];
  uint found = 0u;
  for (uint first = 0u; first < count; first += STRETCH) {
    for (uint k = 0u; k < STRETCH + 2u * MOST; ++k) common[k] = (uchar)common_bits(codes, count, first + k - MOST);
    const uint here = min(STRETCH, count - first);
    for (uint k = 0u; k < here;) {
      const uint size = begun_subtree(common + MOST + k - 1u);
      if (size != 0u) starts[found++] = first + k;
      k += max(size, 1u);  // no other begins in it
    }
  }
  starts[found] = count;
  total[0] = found;
}

// records, others: count of them, to sort by way of. starts: count + 1 at most.
__kernel void order_few(PRIMITIVES_ARGUMENT, __global Curve* curve, __global uint* codes, __global uint* order,
                        __global record_type* records, __global record_type* others, __global uint* starts,
                        __global uint* total, uint count) {
  Bounds b = no_bounds();
  for (uint i = 0u; i < count; ++i) {
    const float3 c = centre2(bounds_at(PRIMITIVE(i)));
    b.lo = smaller3(c, b.lo);
    b.hi = larger3(c, b.hi);
  }
  make_curve(b.lo, b.hi, curve);
  for (uint i = 0u; i < count; ++i) records[i] = record_of(code_along(curve, centre2(bounds_at(PRIMITIVE(i)))), i);
  write_apart(sort_bucket(records, others, records, count, lowest_bits(KEY_BITS)), 0u, count, codes, order);
  list_few(codes, count, starts, total);
}
