// A stable LSD radix sort of keys with 32-bit values, for devices whose work-items are a CPU's threads:
// each takes a large tile (serial_runs.h), by digits so wide that few passes suffice. From the first pass to
// the last a key and its value are one record.
#include "build_layout.h"
#include "serial_runs.h"

static inline uint digit_of(key_type key, uint shift, uint mask) { return (uint)(key >> shift) & mask; }

__kernel void count_keys(__global const key_type* keys, __global uint* counts, uint count, uint tile,
                         uint shift, uint mask, __global const BucketPlan* plan) {
  if (plan->is_used != 0u) return;
  uint own[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) own[d] = 0u;
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    ++own[digit_of(keys[i], shift, mask)];
  store_counts(own, counts);
}

__kernel void count_records(__global const record_type* records, __global uint* counts, uint count,
                            uint tile, uint shift, uint mask, __global const BucketPlan* plan) {
  if (plan->is_used != 0u) return;
  uint own[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) own[d] = 0u;
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i)
    ++own[digit_of(key_of(records[i]), shift, mask)];
  store_counts(own, counts);
}

__kernel void scan_counts(__global uint* counts, uint tiles, __global const BucketPlan* plan) {
  if (plan->is_used == 0u) scan_digits(counts, tiles);
}

// From keys and values to records. If `is_first_order` a value is its key's index, and `values` is not
// read.
__kernel void scatter_keys(__global const key_type* keys, __global const uint* values,
                           __global const uint* places, __global record_type* out, uint count,
                           uint tile, uint shift, uint mask, uint is_first_order,
                           __global const BucketPlan* plan) {
  if (plan->is_used != 0u) return;
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
                              uint mask, __global const BucketPlan* plan) {
  if (plan->is_used != 0u) return;
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
                            uint shift, uint mask, __global const BucketPlan* plan) {
  if (plan->is_used != 0u) return;
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
