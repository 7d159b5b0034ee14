// A stable sort of keys with 32-bit values in two walks over memory, however many bits the keys have, for
// devices whose work-items are a CPU's threads: records go to buckets by their keys' upper bits
// (bucket_plan.h), and each bucket is sorted in a core's caches (bucket_sort.h). Keys that do not spread over
// buckets are left to radix_serial.cl: plan_buckets says so, and one or the other's kernels do nothing.
#include "bucket_plan.h"
#include "bucket_sort.h"
#include "serial_runs.h"

// One work-item. `most`: keys that a bucket should have at most. There are more buckets than 2^bucket_bits if
// they are needed for that.
__kernel void plan_buckets(__global const key_type* keys, __global BucketPlan* plan, uint count, uint bits,
                           uint bucket_bits, uint most) {
  key_type sample[SAMPLES];
  const uint samples = min(count, SAMPLES), stride = count / samples;
  key_type lo = ~(key_type)0, hi = 0u;
  for (uint s = 0u; s < samples; ++s) {
    sample[s] = keys[sample_of(s, stride)] & lowest_bits(bits);
    lo = min(lo, sample[s]);
    hi = max(hi, sample[s]);
  }
  cut_type c;
  uint others;
  do {
    c = cut_between(lo, hi, bucket_bits);
    others = crowded(sample, samples, c, most / stride);
  } while (others > samples / 16u && ++bucket_bits <= MOST_BUCKET_BITS);
  plan->least_low = (uint)c.least;
  plan->least_high = (uint)((ulong)c.least >> 32);
  plan->shift = c.shift;
  plan->buckets = c.last + 1u;
  plan->is_used = others <= samples / 16u;
  plan->next = 0u;
}

__kernel void count_buckets(__global const key_type* keys, __global uint* counts, uint count, uint tile,
                            uint bits, __global const BucketPlan* plan) {
  if (plan->is_used == 0u) return;
  uint own[DIGITS];
  for (uint d = 0u; d < DIGITS; ++d) own[d] = 0u;
  const cut_type c = cut_of(plan, bits);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  for (uint i = first_of(get_global_id(0), tile, count); i < end; ++i) ++own[bucket_of(c, keys[i])];
  store_counts(own, counts);
}

__kernel void scan_buckets(__global uint* counts, uint tiles, __global const BucketPlan* plan) {
  if (plan->is_used != 0u) scan_digits(counts, tiles);
}

// From keys and values to records. If `is_first_order` a value is its key's index, and `values` is not
// read.
__kernel void scatter_buckets(__global const key_type* keys, __global const uint* values,
                              __global const uint* places, __global record_type* out, uint count, uint tile,
                              uint bits, uint is_first_order, __global const BucketPlan* plan) {
  if (plan->is_used == 0u) return;
  record_type lines[DIGITS][LINE];
  runs_type runs;
  begin_runs(&runs, places, get_global_id(0));
  const cut_type c = cut_of(plan, bits);
  const uint first = first_of(get_global_id(0), tile, count);
  const uint end = first_of(get_global_id(0) + 1u, tile, count);
  if (is_first_order)
    for (uint i = first; i < end; ++i)
      put_record(&runs, lines, bucket_of(c, keys[i]), record_of(keys[i], i), out);
  else
    for (uint i = first; i < end; ++i)
      put_record(&runs, lines, bucket_of(c, keys[i]), record_of(keys[i], values[i]), out);
  end_runs(&runs, lines, out);
}

// As write_apart, past the caches where it can.
static inline void write_far_apart(__global const record_type* in, uint begin, uint end,
                                   __global key_type* keys, __global uint* values) {
  const uint first = min((begin + APART_LINE - 1u) / APART_LINE * APART_LINE, end);
  const uint last = max(end / APART_LINE * APART_LINE, first);
  write_apart(in, begin, first, keys, values);
  for (uint i = first; i < last; i += APART_LINE) {
    record_type line[APART_LINE];
    for (uint j = 0u; j < APART_LINE; ++j) line[j] = in[i - begin + j];
    write_line_apart(line, keys + i, values + i);
  }
  write_apart(in + (last - begin), last, end, keys, values);
}

// Buckets to sorted keys and values. Each work-item has its own twice `room` records of `cached`, which stay
// in its core's cache; a bucket that is larger goes by way of `others`. `begins`: of tile 0, where each
// bucket's records begin.
__kernel void sort_buckets(__global record_type* records, __global record_type* others,
                           __global record_type* cached, __global const uint* begins, __global key_type* keys,
                           __global uint* values, uint count, uint bits, uint room,
                           __global BucketPlan* plan) {
  if (plan->is_used == 0u) return;
  __global record_type* own = cached + get_global_id(0) * 2u * room;
  const uint buckets = plan->buckets;
  for (uint b = atomic_inc(&plan->next); b < buckets; b = atomic_inc(&plan->next)) {
    const uint begin = begins[b], end = b + 1u < buckets ? begins[b + 1u] : count;
    const bool fits = end - begin <= room;
    __global record_type* in = records + begin;
    in = sort_bucket(in, fits ? own : others + begin, fits ? own + room : in, end - begin, lowest_bits(bits));
    write_far_apart(in, begin, end, keys, values);
  }
}

// Few keys: one work-item sorts them all as a bucket.
__kernel void sort_few(__global key_type* keys, __global uint* values, __global record_type* records,
                       __global record_type* others, uint count, uint bits, uint is_first_order) {
  for (uint i = 0u; i < count; ++i) records[i] = record_of(keys[i], is_first_order ? i : values[i]);
  write_apart(sort_bucket(records, others, records, count, lowest_bits(bits)), 0u, count, keys, values);
}
