// Where a tile's keys of each digit go, counted before they go (cl/radix_sort.cl without look-back): each
// tile counts its digits, and the counts, digit after digit and tile after tile, become the sums of
// those before them: in two steps, of a group for each of at most ADDERS chunks of them.
#include "group_sum.h"
#include "radix_digit.h"

#define ADDERS 256

// counts[digit * tiles + tile]: how many keys of the tile have the digit.
__kernel __attribute__((reqd_work_group_size(GROUP, 1, 1))) void count_digits(
    __global const KEY* keys, __global uint* counts, uint count, uint shift, uint mask) {
  __local uint own[256];
  const uint lid = (uint)get_local_id(0), tile = (uint)get_group_id(0);
  for (uint d = lid; d < DIGITS; d += GROUP) own[d] = 0u;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint base = tile * TILE, held = min(count - base, (uint)TILE);
  for (uint i = lid; i < held; i += GROUP) atomic_inc(&own[digit_of(keys[base + i], shift, mask)]);
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint d = lid; d < DIGITS; d += GROUP) counts[(size_t)d * get_num_groups(0) + tile] = own[d];
}

// totals[chunk]: the sum of a group's part of counts[0 .. length).
__kernel __attribute__((reqd_work_group_size(ADDERS, 1, 1))) void sum_chunks(
    __global const uint* counts, __global uint* totals, uint length,
    uint chunk_length) {
  __local uint sums[ADDERS];
  const uint lid = (uint)get_local_id(0), chunk = (uint)get_group_id(0);
  const uint begin = chunk * chunk_length, end = min(begin + chunk_length, length);
  uint sum = 0u;
  for (uint i = begin + lid; i < end; i += ADDERS) sum += counts[i];
  const uint before = sum_before(sum, sums);
  if (lid == ADDERS - 1u) totals[chunk] = before + sum;
}

// counts[i] becomes the sum of those before it.
__kernel __attribute__((reqd_work_group_size(ADDERS, 1, 1))) void scan_chunks(
    __global uint* counts, __global const uint* totals, uint length,
    uint chunk_length) {
  __local uint sums[ADDERS];
  __local uint running[1];
  const uint lid = (uint)get_local_id(0), chunk = (uint)get_group_id(0);
  const uint before_chunk = sum_before(lid < get_num_groups(0) ? totals[lid] : 0u, sums);
  if (lid == chunk) running[0] = before_chunk;
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint begin = chunk * chunk_length, end = min(begin + chunk_length, length);
  uint sum = running[0];
  for (uint i = begin; i < end; i += ADDERS) {
    const uint own = i + lid < end ? counts[i + lid] : 0u;
    const uint before = sum_before(own, sums);
    if (i + lid < end) counts[i + lid] = sum + before;
    sum += sums[ADDERS - 1];
    barrier(CLK_LOCAL_MEM_FENCE);
  }
}
