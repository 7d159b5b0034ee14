// Floats as integers in the same order: atomics can bound them, and any are sorted.
#ifndef FACET_ORDERED_H
#define FACET_ORDERED_H

// Numbers that are none have a place, too; 0 and -0 have one each.
static inline uint ordered(float x) {
  const uint bits = as_uint(x);
  return bits ^ ((bits >> 31) != 0u ? 0xffffffffu : 0x80000000u);
}
static inline float unordered(uint x) {
  return as_float(x ^ ((x >> 31) != 0u ? 0x80000000u : 0xffffffffu));
}
#define ORDERED_LEAST 0u
#define ORDERED_MOST 0xffffffffu

#endif
