// One pass of a stable LSD radix sort of keys with 32-bit values, by the digit of 8 bits at
// `shift`: count, scan, scatter. A work-item takes a tile of consecutive keys and walks it in
// order, which keeps equal digits in order without any exchange between work-items.
//
// KEY is uint or ulong.
#ifndef KEY
#define KEY uint
#endif
#define DIGITS 256u

static inline uint digit_of(KEY key, uint shift) { return (uint)(key >> shift) & (DIGITS - 1u); }

// counts[tile * DIGITS + digit]: how many keys of the tile have the digit.
__kernel void count_digits(__global const KEY* keys, __global uint* counts, uint count, uint tile,
                           uint shift) {
  const uint group = (uint)get_global_id(0);
  const ulong first = (ulong)group * tile;
  if (first >= count) return;
  uint histogram[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) histogram[d] = 0u;
  const uint last = (uint)min(first + tile, (ulong)count);
  for (uint i = (uint)first; i < last; ++i) ++histogram[digit_of(keys[i], shift)];
  for (uint d = 0u; d < DIGITS; ++d) counts[group * DIGITS + d] = histogram[d];
}

// Counts become the place of each tile's first key with each digit. One group of DIGITS
// work-items: digit d sums its column, the totals are scanned in local memory, and the column is
// written back as running places.
__kernel __attribute__((reqd_work_group_size(256, 1, 1))) void scan_digits(__global uint* counts,
                                                                           uint tiles) {
  __local uint totals[DIGITS];
  const uint d = (uint)get_local_id(0);
  uint total = 0u;
  for (uint t = 0u; t < tiles; ++t) total += counts[t * DIGITS + d];
  totals[d] = total;
  barrier(CLK_LOCAL_MEM_FENCE);
  for (uint step = 1u; step < DIGITS; step *= 2u) {
    const uint before = d >= step ? totals[d - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    totals[d] += before;
    barrier(CLK_LOCAL_MEM_FENCE);
  }
  uint place = totals[d] - total;
  for (uint t = 0u; t < tiles; ++t) {
    const uint here = counts[t * DIGITS + d];
    counts[t * DIGITS + d] = place;
    place += here;
  }
}

__kernel void scatter(__global const KEY* keys, __global const uint* values,
                      __global const uint* places, __global KEY* keys_out,
                      __global uint* values_out, uint count, uint tile, uint shift) {
  const uint group = (uint)get_global_id(0);
  const ulong first = (ulong)group * tile;
  if (first >= count) return;
  uint place[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) place[d] = places[group * DIGITS + d];
  const uint last = (uint)min(first + tile, (ulong)count);
  for (uint i = (uint)first; i < last; ++i) {
    const KEY key = keys[i];
    const uint to = place[digit_of(key, shift)]++;
    keys_out[to] = key;
    values_out[to] = values[i];
  }
}
