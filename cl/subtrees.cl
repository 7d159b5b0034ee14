// Cuts the sorted places into the largest subtrees of the radix tree that have at most MOST places, and
// lists where they begin, in order.
#include "radix_tree.h"

#ifndef MOST
#define MOST 32u
#endif

// counts[tile]: how many begin in the tile's places.
__kernel void count_subtrees(__global const uint* codes, __global uint* counts, uint count, uint tile,
                             __local uint* sum) {
  const uint lid = (uint)get_local_id(0), at = (uint)get_group_id(0);
  if (lid == 0u) sum[0] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  uint own = 0u;
  const uint end = min((at + 1u) * tile, count);
  for (uint i = at * tile + lid; i < end; i += (uint)get_local_size(0))
    own += begins_subtree(codes, count, i, MOST);
  atomic_add(&sum[0], own);
  barrier(CLK_LOCAL_MEM_FENCE);
  if (lid == 0u) counts[at] = sum[0];
}

// counts become the sums of those before them; total[0] is that of all. One group; sums: a word for
// each of its work-items.
__kernel void scan_tiles(__global uint* counts, __global uint* total, uint tiles, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0);
  const uint share = (tiles + size - 1u) / size;
  const uint begin = min(lid * share, tiles), end = min(begin + share, tiles);
  uint own = 0u;
  for (uint i = begin; i < end; ++i) own += counts[i];
  sums[lid] = own;
  for (uint step = 1u; step < size; step *= 2u) {
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint more = lid >= step ? sums[lid - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[lid] += more;
  }
  uint before = sums[lid] - own;
  for (uint i = begin; i < end; ++i) {
    const uint here = counts[i];
    counts[i] = before;
    before += here;
  }
  if (lid == size - 1u) total[0] = before;
}

// starts[k]: where subtree k begins; starts[k + 1]: where it ends. sums: as above.
__kernel void list_subtrees(__global const uint* codes, __global const uint* counts, __global uint* starts,
                            uint count, uint tile, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0), at = (uint)get_group_id(0);
  const uint end = min((at + 1u) * tile, count);
  uint next = counts[at];
  for (uint first = at * tile; first < end; first += size) {
    const uint i = first + lid;
    const uint own = i < end && begins_subtree(codes, count, i, MOST);
    sums[lid] = own;
    for (uint step = 1u; step < size; step *= 2u) {
      barrier(CLK_LOCAL_MEM_FENCE);
      const uint more = lid >= step ? sums[lid - step] : 0u;
      barrier(CLK_LOCAL_MEM_FENCE);
      sums[lid] += more;
    }
    barrier(CLK_LOCAL_MEM_FENCE);
    if (own != 0u) starts[next + sums[lid] - 1u] = i;
    next += sums[size - 1u];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  if (lid == 0u && end == count) starts[next] = count;
}
