// A stable LSD radix sort of keys with 32-bit values, for devices whose work-items are a CPU's threads:
// each takes a large tile of consecutive keys and walks it in order, by digits so wide that few
// passes suffice. From the first pass to the last a key and its value are one record.
//
// KEY_BITS is 32 or 64.
#ifndef KEY_BITS
#define KEY_BITS 32
#endif
#define DIGITS 2048u

#if KEY_BITS == 32
typedef uint key_type;
typedef ulong record_type;
static inline record_type record_of(key_type key, uint value) { return (ulong)key << 32 | value; }
static inline key_type key_of(record_type r) { return (uint)(r >> 32); }
static inline uint value_of(record_type r) { return (uint)r; }
#else
typedef ulong key_type;
typedef ulong2 record_type;
static inline record_type record_of(key_type key, uint value) { return (ulong2)(key, value); }
static inline key_type key_of(record_type r) { return r.x; }
static inline uint value_of(record_type r) { return (uint)r.y; }
#endif

static inline uint digit_of(key_type key, uint shift, uint mask) { return (uint)(key >> shift) & mask; }

// Work-item t's tile: from first_of(t) to, but not, first_of(t + 1).
static inline uint first_of(size_t t, uint tile, uint count) { return (uint)min((ulong)t * tile, (ulong)count); }

// counts[tile * DIGITS + digit]: how many keys of the tile have the digit.
static inline void store_counts(const uint* own, __global uint* counts) {
  for (uint d = 0u; d < DIGITS; ++d) counts[get_global_id(0) * DIGITS + d] = own[d];
}

__kernel void count_keys(__global const key_type* keys, __global uint* counts, uint count, uint tile,
                         uint shift, uint mask) {
  uint own[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) own[d] = 0u;
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    ++own[digit_of(keys[i], shift, mask)];
  store_counts(own, counts);
}

__kernel void count_records(__global const record_type* records, __global uint* counts, uint count,
                            uint tile, uint shift, uint mask) {
  uint own[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) own[d] = 0u;
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    ++own[digit_of(key_of(records[i]), shift, mask)];
  store_counts(own, counts);
}

// Counts become the place of each tile's first key with each digit. One work-item.
__kernel void scan_counts(__global uint* counts, uint tiles) {
  uint place[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) place[d] = 0u;
  for (uint t = 0u; t < tiles; ++t)
    for (uint d = 0u; d < DIGITS; ++d) place[d] += counts[t * DIGITS + d];
  uint sum = 0u;
  for (uint d = 0u; d < DIGITS; ++d) {
    const uint own = place[d];
    place[d] = sum;
    sum += own;
  }
  for (uint t = 0u; t < tiles; ++t)
    for (uint d = 0u; d < DIGITS; ++d) {
      const uint own = counts[t * DIGITS + d];
      counts[t * DIGITS + d] = place[d];
      place[d] += own;
    }
}

static inline void load_places(__global const uint* places, uint* place) {
  for (uint d = 0u; d < DIGITS; ++d) place[d] = places[get_global_id(0) * DIGITS + d];
}

// From keys and values to records. If `is_first_order` a value is its key's index, and `values` is not
// read.
__kernel void scatter_keys(__global const key_type* keys, __global const uint* values,
                           __global const uint* places, __global record_type* out, uint count,
                           uint tile, uint shift, uint mask, uint is_first_order) {
  uint place[DIGITS];
  load_places(places, place);
  const uint first = first_of(get_global_id(0), tile, count);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  if (is_first_order)
    for (uint i = first; i < end; ++i)
      out[place[digit_of(keys[i], shift, mask)]++] = record_of(keys[i], i);
  else
    for (uint i = first; i < end; ++i)
      out[place[digit_of(keys[i], shift, mask)]++] = record_of(keys[i], values[i]);
}

__kernel void scatter_records(__global const record_type* records, __global const uint* places,
                              __global record_type* out, uint count, uint tile, uint shift,
                              uint mask) {
  uint place[DIGITS];
  load_places(places, place);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    out[place[digit_of(key_of(records[i]), shift, mask)]++] = records[i];
}

// From records to keys and values.
__kernel void scatter_apart(__global const record_type* records, __global const uint* places,
                            __global key_type* keys, __global uint* values, uint count, uint tile,
                            uint shift, uint mask) {
  uint place[DIGITS];
  load_places(places, place);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i) {
    const record_type r = records[i];
    const uint to = place[digit_of(key_of(r), shift, mask)]++;
    keys[to] = key_of(r);
    values[to] = value_of(r);
  }
}

// The same after a pass that was first and last.
__kernel void take_apart(__global const record_type* records, __global key_type* keys,
                         __global uint* values, uint count, uint tile) {
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i) {
    keys[i] = key_of(records[i]);
    values[i] = value_of(records[i]);
  }
}
