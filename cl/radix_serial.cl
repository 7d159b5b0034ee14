// A stable LSD radix sort of keys with 32-bit values, for devices whose work-items are a CPU's threads:
// each takes a large tile of consecutive keys and walks it in order, by digits so wide that few
// passes suffice. From the first pass to the last a key and its value are one record.
//
// Memory is written by whole lines, gathered for each digit ("software write-combining": a store to a
// place of its own for each record would have the line read first, and more lines open than a core's
// caches and address translations hold).
#include "sort_record.h"

#define DIGITS 2048u

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

// A tile's runs of each digit: where they begin, and where the next record goes. Records not written yet
// wait in the digit's line, at their place modulo its length; what is before `begin` in a line of
// memory is another tile's.
typedef struct {
  uint begin[DIGITS], next[DIGITS];
} runs_type;

static inline void begin_runs(runs_type* runs, __global const uint* places, size_t tile) {
  for (uint d = 0u; d < DIGITS; ++d) runs->begin[d] = runs->next[d] = places[tile * DIGITS + d];
}

// The first of a run's places before `next` that is not written yet: at most `length`, a line, of them.
static inline uint unwritten(const runs_type* runs, uint digit, uint next, uint length) {
  return max(runs->begin[digit], (next - 1u) / length * length);
}

static inline void write_some(const record_type* line, uint from, uint to, __global record_type* out) {
  for (uint i = from; i < to; ++i) out[i] = line[i % LINE];
}

static inline void put_record(runs_type* runs, record_type (*lines)[LINE], uint digit, record_type r,
                              __global record_type* out) {
  const uint at = runs->next[digit]++;
  record_type* line = lines[digit];
  line[at % LINE] = r;
  if (at % LINE != LINE - 1u) return;
  const uint first = unwritten(runs, digit, at + 1u, LINE);
  if (first + LINE == at + 1u)
    write_line(line, out + first);
  else
    write_some(line, first, at + 1u, out);
}

static inline void end_runs(const runs_type* runs, record_type (*lines)[LINE], __global record_type* out) {
  for (uint d = 0u; d < DIGITS; ++d)
    write_some(lines[d], max(runs->begin[d], runs->next[d] / LINE * LINE), runs->next[d], out);
}

// From keys and values to records. If `is_first_order` a value is its key's index, and `values` is not
// read.
__kernel void scatter_keys(__global const key_type* keys, __global const uint* values,
                           __global const uint* places, __global record_type* out, uint count,
                           uint tile, uint shift, uint mask, uint is_first_order) {
  record_type lines[DIGITS][LINE];
  runs_type runs;
  begin_runs(&runs, places, get_global_id(0));
  const uint first = first_of(get_global_id(0), tile, count);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  if (is_first_order)
    for (uint i = first; i < end; ++i)
      put_record(&runs, lines, digit_of(keys[i], shift, mask), record_of(keys[i], i), out);
  else
    for (uint i = first; i < end; ++i)
      put_record(&runs, lines, digit_of(keys[i], shift, mask), record_of(keys[i], values[i]), out);
  end_runs(&runs, lines, out);
}

__kernel void scatter_records(__global const record_type* records, __global const uint* places,
                              __global record_type* out, uint count, uint tile, uint shift,
                              uint mask) {
  record_type lines[DIGITS][LINE];
  runs_type runs;
  begin_runs(&runs, places, get_global_id(0));
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    put_record(&runs, lines, digit_of(key_of(records[i]), shift, mask), records[i], out);
  end_runs(&runs, lines, out);
}

static inline void write_some_apart(const record_type* line, uint from, uint to, __global key_type* keys,
                                    __global uint* values) {
  for (uint i = from; i < to; ++i) {
    keys[i] = key_of(line[i % APART_LINE]);
    values[i] = value_of(line[i % APART_LINE]);
  }
}

// From records to keys and values.
__kernel void scatter_apart(__global const record_type* records, __global const uint* places,
                            __global key_type* keys, __global uint* values, uint count, uint tile,
                            uint shift, uint mask) {
  record_type lines[DIGITS][APART_LINE];
  runs_type runs;
  begin_runs(&runs, places, get_global_id(0));
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i) {
    const record_type r = records[i];
    const uint digit = digit_of(key_of(r), shift, mask);
    const uint at = runs.next[digit]++;
    lines[digit][at % APART_LINE] = r;
    if (at % APART_LINE != APART_LINE - 1u) continue;
    const uint first = unwritten(&runs, digit, at + 1u, APART_LINE);
    if (first + APART_LINE == at + 1u)
      write_line_apart(lines[digit], keys + first, values + first);
    else
      write_some_apart(lines[digit], first, at + 1u, keys, values);
  }
  for (uint d = 0u; d < DIGITS; ++d)
    write_some_apart(lines[d], max(runs.begin[d], runs.next[d] / APART_LINE * APART_LINE), runs.next[d],
                     keys, values);
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
