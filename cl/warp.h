// What the 32 work-items of a warp tell each other, and words that work-groups tell each other while
// both run. FACET_PTX: inline PTX of sm_70 and later. Without it a work-item is a warp by itself, and
// words are OpenCL's atomics.
#ifndef FACET_WARP_H
#define FACET_WARP_H

// Before loops over a work-item's registers.
#ifdef FACET_PTX
#define UNROLL _Pragma("unroll")
#else
#define UNROLL
#endif

#ifdef FACET_PTX

#define WARP_SIZE 32u
#define WHOLE_WARP "0xffffffff"

// Work-items of a one-dimensional group are put into warps in order of their local ids.
static inline uint warp_lane(uint lid) { return lid % WARP_SIZE; }
static inline uint lanes_below(uint lane) { return (1u << lane) - 1u; }

// Of the lanes that are set, at least one.
static inline uint highest_lane(uint lanes) {
  uint lane;
  __asm__("bfind.u32 %0, %1;" : "=r"(lane) : "r"(lanes));
  return lane;
}

// All work-items of the warp call these together, but for active_lanes.

// Bit l is set where lane l gives a value that is not 0.
static inline uint warp_ballot(uint value) {
  uint lanes;
  __asm__ volatile(
      "{ .reg .pred p; setp.ne.u32 p, %1, 0; vote.sync.ballot.b32 %0, p, " WHOLE_WARP "; }"
      : "=r"(lanes)
      : "r"(value));
  return lanes;
}

// How many of the lanes that run together with this one give true; not all need to.
static inline uint active_lanes(bool is_so) {
  uint lanes;
  __asm__ volatile(
      "{ .reg .pred p; .reg .b32 active; activemask.b32 active; setp.ne.u32 p, %1, 0;"
      " vote.sync.ballot.b32 %0, p, active; }"
      : "=r"(lanes)
      : "r"((uint)is_so));
  return popcount(lanes);
}

// The value of lane `from`.
static inline uint warp_from(uint value, uint from) {
  uint there;
  __asm__ volatile("shfl.sync.idx.b32 %0, %1, %2, 0x1f, " WHOLE_WARP ";"
                   : "=r"(there)
                   : "r"(value), "r"(from));
  return there;
}

// The sum of the values of this lane and all below.
static inline ulong warp_sum_up_to(uint lid, ulong value) {
  const uint lane = warp_lane(lid);
  UNROLL
  for (uint step = 1u; step < WARP_SIZE; step *= 2u) {
    const uint from = lane - step & WARP_SIZE - 1u;
    const ulong there = (ulong)warp_from((uint)(value >> 32), from) << 32 | warp_from((uint)value, from);
    value += lane >= step ? there : 0ul;
  }
  return value;
}

// The lanes whose value of 8 bits is this lane's: by one instruction, which takes longer the more
// different values there are, or by a vote on each bit.
static inline uint warp_equal(uint value) {
#ifdef FACET_SORT_MATCH
  uint lanes;
  __asm__ volatile("match.any.sync.b32 %0, %1, " WHOLE_WARP ";" : "=r"(lanes) : "r"(value));
  return lanes;
#else
  uint lanes = 0xffffffffu;
  for (uint bit = 0u; bit < 8u; ++bit) {
    uint same;
    __asm__ volatile(
        "{ .reg .pred p; .reg .b32 b; and.b32 b, %1, %2; setp.ne.u32 p, b, 0;"
        " vote.sync.ballot.b32 %0, p, " WHOLE_WARP "; @!p not.b32 %0, %0; }"
        : "=r"(same)
        : "r"(value), "r"(1u << bit));
    lanes &= same;
  }
  return lanes;
#endif
}

static inline uint shared_word(__global const uint* word) {
  uint value;
  __asm__ volatile("ld.relaxed.gpu.global.u32 %0, [%1];" : "=r"(value) : "l"(word) : "memory");
  return value;
}
static inline void share_word(__global uint* word, uint value) {
  __asm__ volatile("st.relaxed.gpu.global.u32 [%0], %1;" : : "l"(word), "r"(value) : "memory");
}
// What was shared before is seen before what is shared after, and read after what was read before.
static inline void share_fence(void) { __asm__ volatile("fence.acq_rel.gpu;" : : : "memory"); }

#else

#define WARP_SIZE 1u
static inline uint warp_lane(uint lid) { return 0u; }
static inline uint lanes_below(uint lane) { return 0u; }
static inline uint warp_ballot(uint value) { return value != 0u ? 1u : 0u; }
static inline uint warp_from(uint value, uint from) { return value; }

static inline uint shared_word(__global uint* word) { return atomic_or((volatile __global uint*)word, 0u); }
static inline void share_word(__global uint* word, uint value) {
  atomic_xchg((volatile __global uint*)word, value);
}
static inline void share_fence(void) { mem_fence(CLK_GLOBAL_MEM_FENCE); }

#endif

#endif
