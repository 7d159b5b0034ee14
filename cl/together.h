// Rays of several work-items' worth, one to a pixel, traced as a packet where they stay close (search_packet.h).
#ifndef FACET_TOGETHER_H
#define FACET_TOGETHER_H

#include "search_packet.h"

// Ray i has its place at [i] of each; `which` has bit i for those that there are.
typedef struct {
  float o[3][FACET_PACKET], d[3][FACET_PACKET];
  float tmax[FACET_PACKET], t_end[FACET_PACKET];
  uint which;
} Bundle;

// Fewer rays go alone, each by itself, from the start.
#define FEW_IN_BUNDLE 4u

static inline void put_ray(Bundle* b, uint i, float3 o, float3 d, float tmax, float t_end) {
  b->o[0][i] = o.x, b->o[1][i] = o.y, b->o[2][i] = o.z;
  b->d[0][i] = d.x, b->d[1][i] = d.y, b->d[2][i] = d.z;
  b->tmax[i] = tmax;
  b->t_end[i] = t_end;
  b->which |= 1u << i;
}

static inline float3 row_at(const float a[3][FACET_PACKET], uint i) {
  return (float3)(a[0][i], a[1][i], a[2][i]);
}

static inline Points rows_from(const float a[3][FACET_PACKET], uint part) {
  Points p;
  p.x = vload8(part, a[0]);
  p.y = vload8(part, a[1]);
  p.z = vload8(part, a[2]);
  return p;
}

// Where there is no ray, the first one stands again, and looks for nothing.
static inline bool packet_of_bundle(Bundle* b, float3 reach, PacketPart* part, PacketSpace* world) {
  const uint first = first_lane(b->which);
  for (uint none = ~b->which; none != 0u; none = without_first(none)) {
    const uint i = first_lane(none);
    for (int c = 0; c < 3; ++c) b->o[c][i] = b->o[c][first], b->d[c][i] = b->d[c][first];
    b->tmax[i] = b->tmax[first];
  }
  for (uint k = 0u; k < FACET_PARTS; ++k)
    begin_part(&part[k], rows_from(b->o, k), rows_from(b->d, k), in_all(0.0f), vload8(k, b->tmax));
  if (!packet_of(part, reach, world)) return false;
  for (uint none = ~b->which; none != 0u; none = without_first(none)) {
    const uint i = first_lane(none);
    ((float*)&part[i / FACET_LANES].t)[i % FACET_LANES] = -INFINITY;
  }
  return true;
}

// What a lane has found, as the search of a ray by itself would tell it.
static inline Query query_in_lane(const Scene* s, GEOMETRY positions, const PacketSpace* world,
                                  const PacketPart* part, uint i, uint mode) {
  const PacketPart* p = &part[i / FACET_LANES];
  const uint lane = i % FACET_LANES;
  Query q = found_in_lane(p, lane);
  if (mode == FACET_CLOSEST) {
    const float det = stored_lane(&p->det, lane);
    if (q.slot == FACET_NONE) return q;
    if (det == 0.0f) return met_in_lane(s, positions, p, &world->rays[i / FACET_LANES], lane);
    q.u = stored_lane(&p->v, lane) / det;
    q.v = stored_lane(&p->w, lane) / det;
    q.triangle = s->infos[q.slot].triangle;
    q.instance = instance_of(s, q.place);
    return q;
  }
  if (q.slot != FACET_NONE) q.triangle = 0u;
#ifndef FACET_NO_TRANSPARENCY
  for (int c = 0; c < 3; ++c) q.depth[c] = p->depth[lane][c];
#endif
  return q;
}

SELDOM void each_by_itself(const Scene* s, GEOMETRY positions, const Bundle* b, uint mode, Query* found) {
  for (uint left = b->which; left != 0u; left = without_first(left)) {
    const uint i = first_lane(left);
    found[i] = traverse_to(s, positions, row_at(b->o, i), row_at(b->d, i), 0.0f, b->tmax[i], b->t_end[i], mode);
  }
}

// What each ray of the bundle meets, found[i]. Each starts at t = 0.
static inline void trace_together(const Scene* s, GEOMETRY positions, Bundle* b, uint mode, Query* found) {
  PacketPart part[FACET_PARTS];
  PacketSpace world;
  if (popcount(b->which) < FEW_IN_BUNDLE || s->triangle_count == 0u ||
      !packet_of_bundle(b, s->reach, part, &world))
    return each_by_itself(s, positions, b, mode, found);
#ifndef FACET_NO_TRANSPARENCY
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    part[k].t_end = vload8(k, b->t_end);
    for (uint lane = 0u; lane < FACET_LANES; ++lane)
      for (int c = 0; c < 3; ++c) part[k].depth[lane][c] = 0;
  }
#endif
  search_packet(s, positions, &world, mode, part);
  for (uint left = b->which; left != 0u; left = without_first(left)) {
    const uint i = first_lane(left);
    found[i] = query_in_lane(s, positions, &world, part, i, mode);
  }
}

#endif
