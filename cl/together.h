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

// Fewer rays go alone, each by itself, from the start; and fewer of those that are alike.
#define FEW_IN_BUNDLE 4u
#define FEW_ALIKE 8u

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

// Those of the rays in `some`. Where there is none of them, the first one stands again, and looks for nothing.
static inline bool packet_of_bundle(Bundle* b, uint some, float3 reach, PacketPart* part, PacketSpace* world) {
  const uint first = first_lane(some);
  for (uint none = ~some; none != 0u; none = without_first(none)) {
    const uint i = first_lane(none);
    for (int c = 0; c < 3; ++c) b->o[c][i] = b->o[c][first], b->d[c][i] = b->d[c][first];
    b->tmax[i] = b->tmax[first];
  }
  for (uint k = 0u; k < FACET_PARTS; ++k)
    begin_part(&part[k], rows_from(b->o, k), rows_from(b->d, k), in_all(0.0f), vload8(k, b->tmax));
  if (packet_of(part, reach, world) != WHOLE_PACKET) return false;
  leave_out(part, ~some);
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
    if (det == 0.0f) return met_by(s, positions, part, world, i);
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

APART void each_by_itself(const Scene* s, GEOMETRY positions, const Bundle* b, uint some, uint mode, Query* found) {
  for (; some != 0u; some = without_first(some)) {
    const uint i = first_lane(some);
    found[i] = traverse_to(s, positions, row_at(b->o, i), row_at(b->d, i), 0.0f, b->tmax[i], b->t_end[i], mode);
  }
}

// Those rays as a packet; false if they cannot go together, and then `b` is as it was for them.
static inline bool as_packet(const Scene* s, GEOMETRY positions, Bundle* b, uint some, uint mode, Query* found) {
  PacketPart part[FACET_PARTS];
  PacketSpace world;
  if (s->triangle_count == 0u || !packet_of_bundle(b, some, s->reach, part, &world)) return false;
#ifndef FACET_NO_TRANSPARENCY
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    part[k].t_end = vload8(k, b->t_end);
    for (uint lane = 0u; lane < FACET_LANES; ++lane)
      for (int c = 0; c < 3; ++c) part[k].depth[lane][c] = 0;
  }
#endif
  search_packet(s, positions, &world, some, mode, part);
  for (; some != 0u; some = without_first(some)) {
    const uint i = first_lane(some);
    found[i] = query_in_lane(s, positions, &world, part, i, mode);
  }
  return true;
}

// Rays of one kind can go together: directions with the same signs and the same main axis (space.h:
// main_axis, of each).
static inline uint8 kinds_of(Points d) {
  const Real x = fabs(d.x), y = fabs(d.y), z = fabs(d.z);
  const uint8 axis = y > x ? (z > y ? (uint8)(2u) : (uint8)(1u)) : (z > x ? (uint8)(2u) : (uint8)(0u));
  return axis << 3 | as_uint8(d.x) >> 31 << 2 | as_uint8(d.y) >> 31 << 1 | as_uint8(d.z) >> 31;
}

// The rays of that one's kind.
static inline uint rays_like(const uint8* kinds, uint ray) {
  const uint8 kind = (uint8)(((const uint*)kinds)[ray]);
  uint same = 0u;
  for (uint k = 0u; k < FACET_PARTS; ++k) same |= lanes_of(kinds[k] == kind) << FACET_LANES * k;
  return same;
}

// Kinds change from pixel to pixel along a line: a kind of many of a block's rays has one of its corners.
#define CORNERS 4u
static inline uint corner_ray(uint corner) {
  return (corner & 1u ? FACET_PACKET_COLUMNS - 1u : 0u) + (corner & 2u ? FACET_PACKET - FACET_PACKET_COLUMNS : 0u);
}

// Of rays that cannot all go together those of which many are alike. Gives those that are left.
APART uint by_kinds(const Scene* s, GEOMETRY positions, const Bundle* b, uint mode, Query* found) {
  uint8 kinds[FACET_PARTS];
  for (uint k = 0u; k < FACET_PARTS; ++k) kinds[k] = kinds_of(rows_from(b->d, k));
  uint left = b->which;
  for (uint c = 0u; c < CORNERS; ++c) {
    const uint some = left & rays_like(kinds, corner_ray(c));
    if (popcount(some) < FEW_ALIKE || some == b->which) continue;
    Bundle alike = *b;
    if (as_packet(s, positions, &alike, some, mode, found)) left &= ~some;
  }
  return left;
}

// What each ray of the bundle meets, found[i]. Each starts at t = 0.
static inline void trace_together(const Scene* s, GEOMETRY positions, Bundle* b, uint mode, Query* found) {
  uint alone = b->which;
  if (popcount(alone) >= FEW_IN_BUNDLE)
    alone = as_packet(s, positions, b, alone, mode, found) ? 0u : by_kinds(s, positions, b, mode, found);
  each_by_itself(s, positions, b, alone, mode, found);
}

#endif
