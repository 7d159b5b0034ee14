// Rays of a buffer where a warp's work-items take new ones while others are still on their way: rays that part
// need not be waited for (Aila and Laine, HPG 2009). A ray's way costs so much more than another's that of the
// bounce rays of a picture's hits less than half of a warp is at work otherwise.
//
// A warp takes rays when the steps that its idle lanes have lost cost as much as taking some: as little is lost
// where rays are alike, and end together, as where they are not.
#ifndef FACET_REFILL_H
#define FACET_REFILL_H

#include "trace.h"

// Steps that lanes may lose; of 32 to 512 fewer are better for rays that part, more for those that do not.
#define LOST_STEPS 48u

// The rays of a launch, as one warp sees them.
typedef struct {
  uint count;
  volatile __global uint* next;  // the first that none has taken
  bool is_more;
  uint lost;  // steps, by idle lanes, since the warp has taken rays
} Supply;

static inline Supply supply_of(uint count, volatile __global uint* next) {
  Supply all;
  all.count = count;
  all.next = next;
  all.is_more = true;
  all.lost = 0u;
  return all;
}

// Whether those idle lanes take rays now, or those of a warp that is done end. All lanes call it.
static inline bool is_time(Supply* all, uint idle) {
  const uint n = popcount(idle);
  all->lost += n;
  return n == WARP_SIZE || (all->is_more && all->lost >= LOST_STEPS);
}

// A ray for an idle lane, or FACET_NONE. All lanes call it.
static inline uint taken(Supply* all, uint idle, bool is_idle) {
  const uint lane = warp_lane((uint)get_local_id(0)), n = popcount(idle);
  uint first = 0u;
  if (lane == 0u) first = atomic_add(all->next, n);
  first = warp_from(first, 0u);
  all->is_more = first + n < all->count;
  all->lost = 0u;
  const uint mine = first + popcount(idle & lanes_below(lane));
  return is_idle && mine < all->count ? mine : FACET_NONE;
}

// Work-items are as many as there is room for.
static inline void trace_refilled(const Scene* s, GEOMETRY positions, __global const Ray* rays, __global Hit* hits,
                                  __global uint* instances, uint mode, Supply all) {
  uint waiting[FACET_STACK];
  float near_of[FACET_STACK];
  Walk w;
  Query q;
  Space space;
  float start = 0.0f;
  uint ray = FACET_NONE;
  w.node = FACET_NONE;
  for (;;) {
    const uint idle = warp_ballot(w.node == FACET_NONE);
    if (is_time(&all, idle)) {
      if (w.node == FACET_NONE && ray != FACET_NONE) {
        if (mode == FACET_CLOSEST)
          finish(s, positions, vec_global(rays[ray].origin), vec_global(rays[ray].direction), &space, &q);
        settle(&q, mode);
        write_hit(hits, instances, ray, &q);
      }
      if (!all.is_more) break;
      const uint next = taken(&all, idle, w.node == FACET_NONE);
      if (w.node == FACET_NONE) ray = next;
      if (next != FACET_NONE) {
        __global const Ray* r = rays + next;
        if (begin_query(s, vec_global(r->origin), vec_global(r->direction), r->tmin, r->tmax, 0.0f, &q, &space,
                        &start))
          begin_walk(s, &space, &w);
      }
    }
    if (w.node != FACET_NONE)
      step(s, positions, vec_global(rays[ray].origin), vec_global(rays[ray].direction), start, mode, &space, &q, &w,
           waiting, near_of);
  }
}

// The steps of one ray to its closest hit, alone.
static inline uint steps_of(const Scene* s, GEOMETRY positions, __global const Ray* r) {
  uint waiting[FACET_STACK], steps = 0u;
  float near_of[FACET_STACK];
  const float3 o = vec_global(r->origin), d = vec_global(r->direction);
  Walk w;
  Query q;
  Space space;
  float start;
  if (!begin_query(s, o, d, r->tmin, r->tmax, 0.0f, &q, &space, &start)) return 0u;
  begin_walk(s, &space, &w);
  for (; w.node != FACET_NONE; ++steps) step(s, positions, o, d, start, FACET_CLOSEST, &space, &q, &w, waiting, near_of);
  return steps;
}

// Adds the steps of a warp's rays to sums[0], and what they would be if all were as long as the longest to sums[1].
// Between the rays of one warp and of the next lie `apart`; no ray lies beyond the last.
static inline void sample_steps(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint apart,
                                volatile __global uint* sums) {
  const uint lane = warp_lane((uint)get_local_id(0));
  const uint mine = steps_of(s, positions, rays + (uint)get_global_id(0) / WARP_SIZE * apart + lane);
  uint most = 0u, sum = 0u;
  for (uint from = 0u; from < WARP_SIZE; ++from) {
    const uint there = warp_from(mine, from);
    most = max(most, there);
    sum += there;
  }
  if (lane != 0u) return;
  atomic_add(&sums[0], sum);
  atomic_add(&sums[1], most * WARP_SIZE);
}

#endif
