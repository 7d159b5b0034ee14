// The stable sort of one bucket's records by a single work-item, in memory that its core's caches hold: by
// the two uppermost digits of the bits in which its keys differ, in which few of them agree, and by insertion
// for those that do. Where many do, by all the digits.
#ifndef FACET_BUCKET_SORT_H
#define FACET_BUCKET_SORT_H
#include "sort_record.h"

// As many lines of memory are written to at once: a core's second cache holds them.
#define WIDEST_DIGIT 10u

// So few records are sorted by insertion alone.
#define FEW 32u

// Of the bits that count, by `mask`, those in which the keys are not all the same.
static inline key_type differing_bits(__global const record_type* in, uint count, key_type mask) {
  const key_type first = key_of(in[0]);
  key_type differing = 0u;
  for (uint i = 1u; i < count; ++i) differing |= key_of(in[i]) ^ first;
  return differing & mask;
}

// Puts what is nearly sorted in order by at most so many moves. False if they do not suffice; keys that are
// the same are in their order either way.
static inline bool insert_all(__global record_type* records, uint count, key_type mask, uint moves) {
  for (uint i = 1u; i < count; ++i) {
    const record_type r = records[i];
    const key_type key = key_of(r) & mask;
    if ((key_of(records[i - 1u]) & mask) <= key) continue;
    uint at = i;
    for (; at > 0u && (key_of(records[at - 1u]) & mask) > key; --at) records[at] = records[at - 1u];
    records[at] = r;
    if (i - at > moves) return false;
    moves -= i - at;
  }
  return true;
}

// Some bits of a key.
typedef struct {
  uint shift, mask;
} digit_type;

static inline uint digit_in(digit_type d, record_type r) { return (uint)(key_of(r) >> d.shift) & d.mask; }
static inline key_type bits_in(digit_type d) { return (key_type)d.mask << d.shift; }
static inline key_type bits_below(uint bit) { return ((key_type)1 << bit) - 1u; }

// The uppermost digit of the bits that are set, or the lowest one: `width` bits at most. Of no bits an empty
// one.
static inline digit_type upper_digit(key_type bits, uint width) {
  const uint end = bit_length(bits), shift = end > width ? end - width : 0u;
  return (digit_type){shift, (uint)bits_below(end - shift)};
}

static inline digit_type lower_digit(key_type bits, uint width) {
  const uint end = bit_length(bits), shift = bits == 0u ? 0u : bit_length(bits & -bits) - 1u;
  return (digit_type){shift, (uint)bits_below(min(end - shift, width))};
}

static inline void move_by_digit(__global const record_type* in, __global record_type* out, uint count,
                                 digit_type d, uint* counts) {
  uint sum = 0u;
  for (uint i = 0u; i <= d.mask; ++i) {
    const uint own = counts[i];
    counts[i] = sum;
    sum += own;
  }
  for (uint i = 0u; i < count; ++i) {
    const record_type r = in[i];
    out[counts[digit_in(d, r)]++] = r;
  }
}

// By two digits, counted together. The outcome is in what is returned: a, b, or `in` if both are empty. `in`
// may be a or b.
static inline __global record_type* sort_by_two(__global record_type* in, __global record_type* a,
                                                __global record_type* b, uint count, digit_type lower,
                                                digit_type upper) {
  uint counts[2][1u << WIDEST_DIGIT];
  for (uint i = 0u; i <= lower.mask; ++i) counts[0][i] = 0u;
  for (uint i = 0u; i <= upper.mask; ++i) counts[1][i] = 0u;
  for (uint i = 0u; i < count; ++i) {
    ++counts[0][digit_in(lower, in[i])];
    ++counts[1][digit_in(upper, in[i])];
  }
  if (lower.mask != 0u) {
    __global record_type* out = in == a ? b : a;
    move_by_digit(in, out, count, lower, counts[0]);
    in = out;
  }
  if (upper.mask != 0u) {
    __global record_type* out = in == a ? b : a;
    move_by_digit(in, out, count, upper, counts[1]);
    in = out;
  }
  return in;
}

// Sorts `in` by way of a and b, which may be `in`, and returns which of the three has the outcome.
static inline __global record_type* sort_bucket(__global record_type* in, __global record_type* a,
                                                __global record_type* b, uint count, key_type mask) {
  if (count <= FEW) {
    insert_all(in, count, mask, FEW * FEW);
    return in;
  }
  key_type left = differing_bits(in, count, mask);
  // Of random keys, at most one in eight agrees with another in twice as many bits.
  const uint width = min((bit_length(count) + 4u) / 2u, WIDEST_DIGIT);
  const digit_type upper = upper_digit(left, width);
  const digit_type lower = upper_digit(left & bits_below(upper.shift), width);
  in = sort_by_two(in, a, b, count, lower, upper);
  if ((left & bits_below(lower.shift)) == 0u || insert_all(in, count, mask, count / 4u)) return in;
  while (left != 0u) {
    const digit_type first = lower_digit(left, WIDEST_DIGIT);
    left &= ~bits_in(first);
    const digit_type second = lower_digit(left, WIDEST_DIGIT);
    left &= ~bits_in(second);
    in = sort_by_two(in, a, b, count, first, second);
  }
  return in;
}

#endif
