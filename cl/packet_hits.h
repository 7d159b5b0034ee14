// What the rays of a packet meet: eight of them and one triangle.
#ifndef FACET_PACKET_HITS_H
#define FACET_PACKET_HITS_H

#include "packet.h"

// Of the best hit.
static inline uint place_in_lane(const PacketPart* p, uint lane) {
#ifdef FACET_NO_INSTANCES
  return 0u;
#else
  return ((const uint*)&p->place)[lane];
#endif
}

static inline void put_place(PacketPart* p, Mask where, uint place) {
#ifndef FACET_NO_INSTANCES
  p->place = where ? (uint8)(place) : p->place;
#endif
}

// What a lane has found so far, as the search of a ray by itself has it before its end.
static inline Query found_in_lane(const PacketPart* p, uint lane) {
  Query q;
  q.t = stored_lane(&p->t, lane);
  q.slot = ((const uint*)&p->slot)[lane];
  q.place = place_in_lane(p, lane);
  q.u = q.v = 0.0f;
  q.instance = q.triangle = FACET_NONE;
  return q;
}

// Of the lanes in `tied`, which meet a triangle at their best hit's distance, those that keep their best hit.
APART Mask keep_of(const Scene* s, const PacketPart* p, uint place, uint slot, uint tied) {
  int keep[FACET_LANES] = {0};
  for (; tied != 0u; tied = without_first(tied)) {
    const uint lane = first_lane(tied), best = ((const uint*)&p->slot)[lane];
    keep[lane] = best == FACET_NONE || is_before(s, place, slot, place_in_lane(p, lane), best) ? 0 : -1;
  }
  return vload8(0, keep);
}

static inline void answer(PacketPart* p, Mask where) {
  p->t = where ? in_all(-INFINITY) : p->t;
  p->slot = where ? (uint8)(0u) : p->slot;
}

#ifndef FACET_NO_TRANSPARENCY
static inline void cross_one(const Scene* s, PacketPart* p, const TriangleHits* hits, Mask met, uint place,
                             uint slot) {
  __global const Material* m = &s->materials[material_of(s, place, slot)];
  if (!m->transparent) return answer(p, met);
  const uint front = lanes_of(hits->is_front);
  for (uint lanes = lanes_of(met & hits->is_counted); lanes != 0u; lanes = without_first(lanes)) {
    const uint lane = first_lane(lanes);
    add_depth(p->depth[lane], m, stored_lane(&p->t_end, lane), stored_lane(&hits->t, lane),
              front >> lane & 1u);
  }
}
#endif

INLINED void meet_one(const Scene* s, GEOMETRY positions, PacketPart* p, const Rays* r, Intervals outer,
                      Triangles one, uint place, uint slot, uint mode) {
  if (is_none(may_be_within(r, one))) return;
  TriangleHits hits;
  Mask met = hit_triangles(r, one, outer, p->tmin, p->t, mode == FACET_CROSSINGS, &hits);
  if (is_none(met | hits.is_doubtful)) return;
  // One branch for what is rare.
  const Mask may_tie = mode == FACET_CLOSEST ? met & (hits.t == p->t) : (Mask)(0);
  if (!is_none(hits.is_doubtful | may_tie)) {
    met = settle_doubts(r, positions, one, outer, p->tmin, p->t, met, &hits);
    const uint tied = mode == FACET_CLOSEST ? lanes_of(met & (hits.t == p->t)) : 0u;
    if (tied != 0u) met &= ~keep_of(s, p, place, slot, tied);
  }
  if (mode == FACET_ANY) return answer(p, met);
#ifndef FACET_NO_TRANSPARENCY
  if (mode == FACET_CROSSINGS) return cross_one(s, p, &hits, met, place, slot);
#endif
  p->t = met ? hits.t : p->t;
  p->v = met ? hits.v : p->v;
  p->w = met ? hits.w : p->w;
  p->det = met ? hits.det : p->det;
  p->slot = met ? (uint8)(slot) : p->slot;
  put_place(p, met, place);
}

// The parts' rays of which there are some in `rays`, and the triangles of a block in the lanes `left`. A literal:
// `is_mixed`, whether rays have two main axes.
INLINED void meet_each(const Scene* s, GEOMETRY positions, uint block, uint left, const PacketSpace* space,
                       PacketPart* part, uint rays, uint mode, bool is_mixed) {
  const Triangles triangles = triangles_from(positions, block);
  for (; left != 0u; left = without_first(left)) {
    const uint at = first_lane(left);
    for (uint k = 0u; k < FACET_PARTS; ++k) {
#ifdef FACET_NO_INSTANCES
      const Intervals outer = {in_all(-INFINITY), in_all(INFINITY)};
      const uint place = 0u;
#else
      const Intervals outer = space->outer[k];
      const uint place = space->place;
#endif
      const Triangles one =
          is_mixed ? mixed_triangle(triangles, at, lanes_among(space->others, k), space->axis_of_others)
                   : one_triangle(triangles, at);
      if (rays >> FACET_LANES * k & 0xffu)
        meet_one(s, positions, &part[k], &space->rays[k], outer, one, place, FACET_LANES * block + at, mode);
    }
  }
}

APART void meet_mixed(const Scene* s, GEOMETRY positions, uint block, uint left, const PacketSpace* space,
                      PacketPart* part, uint rays, uint mode) {
  meet_each(s, positions, block, left, space, part, rays, mode, true);
}

#endif
