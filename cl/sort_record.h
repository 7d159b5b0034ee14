// A key and its value as one record, and how whole lines of records are written: a key is 32 or 64 bits,
// by KEY_BITS.
#ifndef FACET_SORT_RECORD_H
#define FACET_SORT_RECORD_H
#include "device.h"

#ifndef KEY_BITS
#define KEY_BITS 32
#endif

// Records that are written together: two cache lines of them at most, 64 bytes of values.
#define LINE 8u
#define APART_LINE 16u

// `out`, `keys` and `values` are aligned to what is written.
#if KEY_BITS == 32

typedef uint key_type;
typedef ulong record_type;
static inline record_type record_of(key_type key, uint value) { return (ulong)key << 32 | value; }
static inline key_type key_of(record_type r) { return (uint)(r >> 32); }
static inline uint value_of(record_type r) { return (uint)r; }

static inline void write_line(const record_type* line, __global record_type* out) {
  STORE_PAST_CACHES(vload8(0, line), (__global ulong8*)out);
}
static inline void write_line_apart(const record_type* line, __global key_type* keys, __global uint* values) {
  const ulong16 r = vload16(0, line);
  STORE_PAST_CACHES(convert_uint16(r >> 32), (__global uint16*)keys);
  STORE_PAST_CACHES(convert_uint16(r), (__global uint16*)values);
}

#else

typedef ulong key_type;
typedef ulong2 record_type;
static inline record_type record_of(key_type key, uint value) { return (ulong2)(key, value); }
static inline key_type key_of(record_type r) { return r.x; }
static inline uint value_of(record_type r) { return (uint)r.y; }

static inline void write_line(const record_type* line, __global record_type* out) {
  STORE_PAST_CACHES(vload8(0, (const ulong*)line), (__global ulong8*)out);
  STORE_PAST_CACHES(vload8(1, (const ulong*)line), (__global ulong8*)(out + 4));
}
static inline void write_line_apart(const record_type* line, __global key_type* keys, __global uint* values) {
  ulong key[APART_LINE];
  uint value[APART_LINE];
  for (uint i = 0u; i < APART_LINE; ++i) {
    key[i] = line[i].x;
    value[i] = (uint)line[i].y;
  }
  STORE_PAST_CACHES(vload8(0, key), (__global ulong8*)keys);
  STORE_PAST_CACHES(vload8(1, key), (__global ulong8*)(keys + 8));
  STORE_PAST_CACHES(vload16(0, value), (__global uint16*)values);
}

#endif

static inline key_type lowest_bits(uint bits) { return ~(key_type)0 >> (KEY_BITS - bits); }
static inline uint bit_length(key_type k) { return KEY_BITS - (uint)clz(k); }

static inline void write_apart(__global const record_type* in, uint begin, uint end, __global key_type* keys,
                               __global uint* values) {
  for (uint i = begin; i < end; ++i, ++in) {
    keys[i] = key_of(*in);
    values[i] = value_of(*in);
  }
}

#endif
