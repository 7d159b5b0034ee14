// What differs from device to device, behind names; each has a portable form, which is the default or
// is had by FACET_PORTABLE.
#ifndef FACET_DEVICE_H
#define FACET_DEVICE_H

// For what two searches call with vectors, which a call would pass through memory.
#define INLINED __attribute__((always_inline)) static inline

// A function to which the compiler allots registers by itself: what is called seldom takes none where it is not, a
// search is as fast whatever comes before it, and what several call is compiled once.
#define APART __attribute__((noinline)) static

// The larger, or the smaller, by component, where `bound` is never NaN; a NaN in `a` is dropped. The
// sign of a zero may be either: use only where it cannot reach a result. GPUs
// have one instruction for it; PoCL makes calls of fmax and fmin, and of a comparison one instruction.
#ifdef FACET_HARDWARE_MINMAX
#define FACET_CULL_MAX(a, bound) fmax(a, bound)
#define FACET_CULL_MIN(a, bound) fmin(a, bound)
#else
#define FACET_CULL_MAX(a, bound) ((a) > (bound) ? (a) : (bound))
#define FACET_CULL_MIN(a, bound) ((a) < (bound) ? (a) : (bound))
#endif
static inline float cull_max1(float a, float bound) { return FACET_CULL_MAX(a, bound); }
static inline float cull_min1(float a, float bound) { return FACET_CULL_MIN(a, bound); }

// The lanes where a comparison of vectors holds, as bits: lane k is bit k. The portable form gathers
// the lowest bits of eight bytes by a product: byte k's comes to bit 56 + k, and nothing carries.
#if defined(__AVX__) && !defined(FACET_PORTABLE)
static inline uint lanes_of(int8 m) { return (uint)__builtin_ia32_movmskps256(as_float8(m)); }
#else
static inline uint lanes_of(int8 m) {
  return (uint)((as_ulong(convert_char8(m)) & 0x0101010101010101ul) * 0x0102040810204080ul >> 56);
}
#endif

// The lowest of the lanes, of which there is at least one.
#if defined(__x86_64__) && !defined(FACET_PORTABLE)
static inline uint first_lane(uint lanes) { return (uint)__builtin_ctz(lanes); }
#else
static inline uint first_lane(uint lanes) { return 31u - clz(lanes & -lanes); }
#endif
static inline uint without_first(uint lanes) { return lanes & (lanes - 1u); }

// Lane k: the lane of `v` that `at` says in its lowest three bits.
#if defined(__AVX2__) && !defined(FACET_PORTABLE)
static inline uint8 picked(uint8 v, uint8 at) {
  return as_uint8(__builtin_ia32_permvarsi256(as_int8(v), as_int8(at)));
}
#else
static inline uint8 picked(uint8 v, uint8 at) {
  uint from[8], lane[8];
  vstore8(v, 0, from);
  vstore8(at & 7u, 0, lane);
  return (uint8)(from[lane[0]], from[lane[1]], from[lane[2]], from[lane[3]], from[lane[4]], from[lane[5]],
                 from[lane[6]], from[lane[7]]);
}
#endif

// The lowest bits of `cell` at the places of the mask's bits, the lowest at the lowest.
static inline uint deposit(uint cell, uint mask) {
#if defined(__BMI2__) && !defined(FACET_PORTABLE)
  return __builtin_ia32_pdep_si(cell, mask);
#else
  uint code = 0u;
  for (; mask != 0u; mask &= mask - 1u, cell >>= 1) code |= (cell & 1u) != 0u ? mask & -mask : 0u;
  return code;
#endif
}

// The same number, which the compiler takes for another: what is read by it is read anew, and need not be kept in
// registers until then.
#if defined(FACET_PTX) && !defined(FACET_PORTABLE)
static inline uint as_another(uint x) {
  __asm__ volatile("" : "+r"(x));
  return x;
}
#else
static inline uint as_another(uint x) { return x; }
#endif

// Asks for the memory from p on, which is read later: `bytes`, a literal of at most 256. No loop: compilers
// leave it one.
#if defined(__x86_64__) && !defined(FACET_PORTABLE)
static inline void fetch_lines(__global const void* p, uint bytes) {
  const size_t first = (size_t)p;
  __builtin_prefetch((const void*)first);
  if (bytes > 64u) __builtin_prefetch((const void*)(first + 64u));
  if (bytes > 128u) __builtin_prefetch((const void*)(first + 128u));
  if (bytes > 192u) __builtin_prefetch((const void*)(first + 192u));
}
#else
static inline void fetch_lines(__global const void* p, uint bytes) {}
#endif

// Stores a vector that will not be read soon: past the caches, where the compiler can be asked for that.
#ifdef __has_builtin
#if __has_builtin(__builtin_nontemporal_store)
#define STORE_PAST_CACHES(vector, pointer) __builtin_nontemporal_store(vector, pointer)
#endif
#endif
#ifndef STORE_PAST_CACHES
#define STORE_PAST_CACHES(vector, pointer) (*(pointer) = (vector))
#endif

#endif
