// How keys are cut into buckets by their upper bits: 2^shift values of a key for each bucket, from the least
// key of a sample on. What lies outside the sample belongs to the first bucket or the last one, so that
// buckets are in order whatever the keys are; the sample decides only how fast they are sorted.
#ifndef FACET_BUCKET_PLAN_H
#define FACET_BUCKET_PLAN_H
#include "build_layout.h"
#include "sort_record.h"

#define MOST_BUCKET_BITS 11u
#define SAMPLES 4096u

// A plan as a work-item keeps it.
typedef struct {
  key_type least, mask;
  uint shift, last;
} cut_type;

static inline cut_type cut_of(__global const BucketPlan* plan, uint bits) {
  cut_type c;
  c.least = (key_type)((ulong)plan->least_high << 32 | plan->least_low);
  c.mask = lowest_bits(bits);
  c.shift = plan->shift;
  c.last = plan->buckets - 1u;
  return c;
}

static inline uint bucket_of(cut_type c, key_type key) {
  return (uint)min(sub_sat(key & c.mask, c.least) >> c.shift, (key_type)c.last);
}

// 2^bits buckets, of which half at least have a key between lo and hi.
static inline cut_type cut_between(key_type lo, key_type hi, uint bits) {
  const uint length = bit_length(hi - lo);
  cut_type c;
  c.mask = ~(key_type)0;
  c.shift = length > bits ? length - bits : 0u;
  c.least = lo >> c.shift << c.shift;  // keys of a bucket have all bits above `shift` in common
  c.last = (1u << bits) - 1u;
  return c;
}

// How many samples are in buckets of more than `most` of them.
static inline uint crowded(const key_type* sample, uint samples, cut_type c, uint most) {
  uint own[1u << MOST_BUCKET_BITS];
  for (uint b = 0u; b <= c.last; ++b) own[b] = 0u;
  for (uint s = 0u; s < samples; ++s) ++own[bucket_of(c, sample[s])];
  uint sum = 0u;
  for (uint b = 0u; b <= c.last; ++b) sum += own[b] > most ? own[b] : 0u;
  return sum;
}

// One of each `stride` keys, anywhere among them, lest keys that repeat in step with it deceive.
static inline uint sample_of(uint s, uint stride) { return s * stride + (s * 2654435761u >> 8) % stride; }

#endif
