// A packet of rays from a buffer, and its hits to one.
#ifndef FACET_TRACE_PACKET_H
#define FACET_TRACE_PACKET_H

#include "together.h"
#include "trace.h"

// The shares of the hits that rays have met alone, in that space.
static inline void find_shares(const Scene* s, GEOMETRY positions, PacketPart* part, const PacketSpace* world) {
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    PacketPart* p = &part[k];
    for (uint lanes = lanes_of((p->slot != FACET_NONE) & (p->det == 0.0f)); lanes != 0u; lanes = without_first(lanes)) {
      const uint lane = first_lane(lanes);
      const Query q = met_by(s, positions, part, world, FACET_LANES * k + lane);
      ((float*)&p->v)[lane] = q.u;
      ((float*)&p->w)[lane] = q.v;
      ((float*)&p->det)[lane] = 1.0f;
    }
  }
}

// Eight hits, 16 bytes each.
static inline void write_hits(__global Hit* hits, Real t, Real u, Real v, uint8 triangle) {
  const Real n = as_float8(triangle);
  __global float8* two = (__global float8*)hits;
  two[0] = (float8)(t.s0, u.s0, v.s0, n.s0, t.s1, u.s1, v.s1, n.s1);
  two[1] = (float8)(t.s2, u.s2, v.s2, n.s2, t.s3, u.s3, v.s3, n.s3);
  two[2] = (float8)(t.s4, u.s4, v.s4, n.s4, t.s5, u.s5, v.s5, n.s5);
  two[3] = (float8)(t.s6, u.s6, v.s6, n.s6, t.s7, u.s7, v.s7, n.s7);
}

static inline void write_part(const Scene* s, const PacketPart* p, uint mode, __global Hit* hits,
                              __global uint* hit_instances) {
  const Mask is_hit = p->slot != FACET_NONE;
  if (mode == FACET_ANY) {
    write_hits(hits, is_hit ? in_all(0.0f) : p->t, in_all(0.0f), in_all(0.0f),
               is_hit ? (uint8)(0u) : (uint8)(FACET_NONE));
#ifndef FACET_NO_INSTANCES
    vstore8(is_hit ? (uint8)(0u) : (uint8)(FACET_NONE), 0, hit_instances);
#endif
    return;
  }
  const Real u = is_hit ? p->v / p->det : in_all(0.0f), v = is_hit ? p->w / p->det : in_all(0.0f);
  uint of[FACET_LANES];
  vstore8(is_hit ? p->slot : (uint8)(0u), 0, of);
  for (uint lane = 0u; lane < FACET_LANES; ++lane) of[lane] = s->infos[of[lane]].triangle;
  write_hits(hits, p->t, u, v, is_hit ? vload8(0, of) : (uint8)(FACET_NONE));
#ifndef FACET_NO_INSTANCES
  for (uint lane = 0u; lane < FACET_LANES; ++lane)
    hit_instances[lane] =
        is_in(is_hit, lane) ? instance_of(s, place_in_lane(p, lane)) : FACET_NONE;
#endif
}

static inline void read_part(__global const Ray* rays, PacketPart* p) {
  __global const Real* from = (__global const Real*)rays;
  Real a[8] = {from[0], from[1], from[2], from[3], from[4], from[5], from[6], from[7]};
  transpose(a);
  const Points o = {a[0], a[1], a[2]}, d = {a[4], a[5], a[6]};
  begin_part(p, o, d, a[3], a[7]);
}

// Asks for the rays of the packet after the next: memory would not come in time for what walks over many.
static inline void fetch_rays(__global const Ray* rays) {
  __global const Ray* next = rays + 2u * FACET_PACKET;
  fetch_lines(next, 256u);
  fetch_lines(next + 8, 256u);
  fetch_lines(next + 16, 256u);
  fetch_lines(next + 24, 256u);
}

// Traces those of FACET_PACKET rays that go together. Gives the others, of whose hits nothing is known.
static inline uint trace_packet(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint mode,
                                __global Hit* hits, __global uint* hit_instances) {
  PacketPart part[FACET_PARTS];
  PacketSpace world;
  if (s->triangle_count == 0u) return WHOLE_PACKET;
  fetch_rays(rays);
  for (uint k = 0u; k < FACET_PARTS; ++k) read_part(rays + FACET_LANES * k, &part[k]);
  const uint together = packet_of(part, s->reach, &world);
  if (together == 0u) return WHOLE_PACKET;
  if (together != WHOLE_PACKET) leave_out(part, ~together);
  search_packet(s, positions, &world, together, mode, part);
  if (mode == FACET_CLOSEST) find_shares(s, positions, part, &world);
  for (uint k = 0u; k < FACET_PARTS; ++k)
    write_part(s, &part[k], mode, hits + FACET_LANES * k, hit_instances + FACET_LANES * k);
  return ~together;
}

APART void trace_alone(const Scene* s, GEOMETRY positions, __global const Ray* rays, uint which, uint mode,
                       __global Hit* hits, __global uint* hit_instances) {
  for (; which != 0u; which = without_first(which)) {
    const uint i = first_lane(which);
    const Query q = traced_query(s, positions, rays + i, mode);
    write_hit(hits, hit_instances, i, &q);
  }
}

#endif
