// Cuts the sorted places into the largest subtrees of the radix tree that have at most MOST places, and lists
// where they begin, in order.
#include "begun_subtree.h"
#include "group_sum.h"

// Places of a work-item that marks them; a multiple of 32 / its group.
#ifndef EACH
#define EACH 1024u
#endif

// Whether one of the subtrees begins at a place: where the node that joins it with the place before has more than
// MOST places. common[k] is of the place k - 1 further.
static inline bool begins_subtree(__local const uchar* common) {
  const uint own = common[0];
  if (own == 0u) return true;
  uint before = 1u, after = 1u;
  while (before < MOST && common[-(int)before] > own) ++before;
  while (before + after <= MOST && common[after] > own) ++after;
  return before + after > MOST;
}

// Bits of marks[] say which places begin one, counts[tile] how many of the tile's. A group takes a tile of
// EACH places a work-item; common: tile + 2 * MOST bytes, bits: tile / 32 words.
__kernel void mark_subtrees(__global const uint* codes, __global uint* marks, __global uint* counts, uint count,
                            __local uchar* common, __local uint* bits) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0), at = (uint)get_group_id(0);
  const uint tile = EACH * size, words = tile / 32u, first = at * tile;
  // common[k] is of place first + k - MOST.
  for (uint k = lid; k < tile + 2u * MOST; k += size)
    common[k] = (uchar)common_bits(codes, count, first + k - MOST);
  for (uint k = lid; k < words; k += size) bits[k] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = lid; k < tile; k += size)
    if (first + k < count && begins_subtree(common + MOST + k - 1u)) atomic_or(&bits[k / 32u], 1u << k % 32u);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint k = lid; k < words; k += size) marks[at * words + k] = bits[k];
  if (lid != 0u) return;
  uint sum = 0u;
  for (uint k = 0u; k < words; ++k) sum += popcount(bits[k]);
  counts[at] = sum;
}

// The same for a CPU: a work-item takes a tile of EACH places alone, and goes from one subtree to the next.
__kernel void mark_subtrees_alone(__global const uint* codes, __global uint* marks, __global uint* counts, uint count) {
  const uint at = (uint)get_global_id(0), first = at * EACH, here = min(EACH, count - first);
  uchar common[EACH + 2u * MOST];
  for (uint k = 0u; k < EACH + 2u * MOST; ++k) common[k] = (uchar)common_bits(codes, count, first + k - MOST);
  uint bits[EACH / 32u], sum = 0u;
  for (uint k = 0u; k < EACH / 32u; ++k) bits[k] = 0u;
  for (uint k = 0u; k < here;) {
    const uint size = begun_subtree(common + MOST + k - 1u);
    if (size != 0u) bits[k / 32u] |= 1u << k % 32u;
    sum += size != 0u ? 1u : 0u;
    k += max(size, 1u);  // no other begins in it
  }
  for (uint k = 0u; k < EACH / 32u; ++k) marks[at * (EACH / 32u) + k] = bits[k];
  counts[at] = sum;
}

// counts become the sums of those before them; total[0] is that of all. One group.
__kernel void scan_tiles(__global uint* counts, __global uint* total, uint tiles, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0);
  const uint share = (tiles + size - 1u) / size;
  const uint begin = min(lid * share, tiles), end = min(begin + share, tiles);
  uint own = 0u;
  for (uint i = begin; i < end; ++i) own += counts[i];
  uint before = sum_before(own, sums);
  for (uint i = begin; i < end; ++i) {
    const uint here = counts[i];
    counts[i] = before;
    before += here;
  }
  if (lid == size - 1u) total[0] = before;
}

// starts[k]: where subtree k begins; starts[k + 1]: where it ends. A group takes a tile's words.
__kernel void list_subtrees(__global const uint* marks, __global const uint* counts, __global const uint* total,
                            __global uint* starts, uint count, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0), at = (uint)get_group_id(0);
  const uint word = at * size + lid;
  uint left = marks[word];
  uint next = counts[at] + sum_before(popcount(left), sums);
  for (; left != 0u; left &= left - 1u) starts[next++] = 32u * word + (31u - clz(left & -left));
  if (word == 0u) starts[total[0]] = count;
}
