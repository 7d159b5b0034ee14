// Rays that are traced together while they stay close, FACET_PACKET of them: the lanes of several vectors.
#ifndef FACET_PACKET_H
#define FACET_PACKET_H

#include "beam.h"
#include "query.h"
#include "transpose.h"

#define FACET_PARTS (FACET_PACKET / FACET_LANES)

// Eight of the rays, and what each has met so far.
typedef struct {
  Points o, d;  // in the world
  Real tmin;
  Real t;          // tmax, or the best hit's; -INFINITY: nothing more is looked for
  Real v, w, det;  // of the best hit (triangle.h: TriangleHits); det 0: not known
  uint8 slot;      // of the best hit; FACET_NONE
#ifndef FACET_NO_INSTANCES
  uint8 place;
#endif
#ifndef FACET_NO_TRANSPARENCY
  Real t_end;  // query.h: Query
  long depth[FACET_LANES][3];
#endif
} PacketPart;

// The rays in one space: the world, or an instance's.
typedef struct {
  Rays rays[FACET_PARTS];
#ifndef FACET_NO_INSTANCES
  Intervals outer[FACET_PARTS];  // of the instance's box in the world; empty for a ray that does not enter
#endif
  Beam beam;
  uint place;  // FACET_NONE: the world
  // Rays with another main axis than that of `rays`, and which. Triangles ask for it, boxes do not.
  uint others, axis_of_others;
} PacketSpace;

static inline uint axis_in_lane(const PacketSpace* in, uint part, uint lane) {
  return in->others >> (FACET_LANES * part + lane) & 1u ? in->axis_of_others : in->rays[part].axis;
}

static inline float3 direction_of(const PacketPart* part, uint ray) {
  return point_in_lane(&part[ray / FACET_LANES].d, ray % FACET_LANES);
}

// Whether on any axis a sign is another than that direction's.
static inline bool do_signs_differ(const PacketPart* part, float3 than) {
  Mask differing = (Mask)(0);
  for (uint k = 0u; k < FACET_PARTS; ++k)
    differing |= (as_int8(part[k].d.x) ^ as_int(than.x)) | (as_int8(part[k].d.y) ^ as_int(than.y)) |
                 (as_int8(part[k].d.z) ^ as_int(than.z));
  return !is_none(differing < 0);
}

// Offsets as seen from the centre.
static inline Points moved_to(float3 centre, Points offset, Points inverse) {
  Points p;
  p.x = fma(in_all(centre.x), inverse.x, offset.x);
  p.y = fma(in_all(centre.y), inverse.y, offset.y);
  p.z = fma(in_all(centre.z), inverse.z, offset.z);
  return p;
}

// False as beam_of_bounds.
static inline bool beam_of(const Rays* rays, const PacketPart* part, float3 centre, Real extent, Beam* b) {
  Points least = rays->inverse, most = least;
  Points near = moved_to(centre, rays->near_offset, least);
  Points far = moved_to(centre, rays->far_offset, least);
  Real tmin = part[0].tmin;
  for (uint k = 1u; k < FACET_PARTS; ++k) {
    const Rays* r = &rays[k];
    least = smaller_points(r->inverse, least);
    most = larger_points(r->inverse, most);
    near = smaller_points(moved_to(centre, r->near_offset, r->inverse), near);
    far = larger_points(moved_to(centre, r->far_offset, r->inverse), far);
    tmin = smaller_each(part[k].tmin, tmin);
  }
  return beam_of_bounds(centre, least, most, near, far, tmin, extent, b);
}

static inline float best_of(const PacketPart* part) {
  Real t = part[0].t;
  for (uint k = 1u; k < FACET_PARTS; ++k) t = larger_each(part[k].t, t);
  return most_of(t);
}

// Rays that look for the nearest hit, or for all that they cross, in tmin to tmax.
static inline void begin_part(PacketPart* p, Points o, Points d, Real tmin, Real tmax) {
  p->o = o;
  p->d = d;
  p->tmin = tmin < 0.0f ? in_all(0.0f) : tmin;
  p->t = tmax;
  p->v = p->w = p->det = in_all(0.0f);
  p->slot = (uint8)(FACET_NONE);
#ifndef FACET_NO_INSTANCES
  p->place = (uint8)(FACET_NONE);
#endif
}

// A packet is worth it where its rays start close to one another: within this share of the space's size.
#ifndef FACET_PACKET_WIDTH
#define FACET_PACKET_WIDTH 0.0625f
#endif

// Whether they start close, and have anything to look for.
static inline bool can_go_together(const PacketPart* part, float3 reach) {
  Points least = part[0].o, most = least;
  Mask has_way = part[0].tmin <= part[0].t;
  for (uint k = 1u; k < FACET_PARTS; ++k) {
    least = smaller_points(part[k].o, least);
    most = larger_points(part[k].o, most);
    has_way &= part[k].tmin <= part[k].t;
  }
  // The least, and of the negative ones, too: bounds of six vectors at once.
  const Each low[8] = {least.x, least.y, least.z, least.z, -most.x, -most.y, -most.z, -most.z};
  const Each from = bounds_of_lanes(low, false);
  const float4 width = -(from.lo + from.hi);
  const Mask is_narrow = (float8)(width, width) <= FACET_PACKET_WIDTH * larger(reach.x, larger(reach.y, reach.z));
  return is_all(has_way & is_narrow);
}

// Rays of a packet are told by a bit each.
#define WHOLE_PACKET 0xffffffffu

// Those whose main axis is the one that they are seen along, and by more than rounding.
static inline Mask are_along(const Rays* r) { return (fabs(r->shear_x) < 1.0f) & (fabs(r->shear_y) < 1.0f); }
// Those whose slabs are the same bits.
static inline Mask have_slabs_of(const Rays* r, const Rays* as) {
  return (r->inverse.x == as->inverse.x) & (r->inverse.y == as->inverse.y) & (r->inverse.z == as->inverse.z);
}

// One in the middle of a packet.
#define FACET_MIDDLE_RAY (FACET_PACKET / 2u + FACET_LANES / 2u)

// Whether rays whose directions have the same signs can be traced together in a space as far as boxes go: not if one
// cannot be used. Of the parts, as seen there, o, d and tmin are asked; triangles ask for the main axis, too.
static inline bool space_of_packet(const PacketPart* part, float3 towards, float3 reach, PacketSpace* space) {
  const float3 centre = (float3)(part->o.x.s0, part->o.y.s0, part->o.z.s0);
  const uint axis = main_axis(towards);
  Real extent = in_all(0.0f), offsets = in_all(0.0f);
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    Real e;
    Rays* r = &space->rays[k];
    rays_of(r, axis, part[k].o, part[k].d, reach, &e);
    extent = larger_each(e, extent);
    offsets += (r->near_offset.x + r->near_offset.y) + r->near_offset.z;
  }
  space->others = 0u;
  // A sum is NaN or infinite where a term is, and an offset where o, d or their product is, but for an infinite
  // d: its inverse is 0, which beam_of finds.
  if (!is_all(fabs(offsets) < INFINITY)) return false;
  return beam_of(space->rays, part, centre, extent, &space->beam);
}

// Of rays that have more than one main axis those that have the packet's or that of the first that does not. Each
// one's inverse is least on its main axis: if theirs is, none is more than the largest on any one axis.
APART uint mix_axes(const PacketPart* part, float3 reach, PacketSpace* space) {
  const int4 flat = are_flat(&space->beam);
  if (is_none((Mask)(flat, flat))) return 0u;
  uint along = 0u;
  for (uint k = 0u; k < FACET_PARTS; ++k) along |= lanes_of(are_along(&space->rays[k])) << FACET_LANES * k;
  if (along == WHOLE_PACKET) return along;
  space->axis_of_others = main_axis(direction_of(part, first_lane(~along)));
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    Rays seen, *r = &space->rays[k];
    Real extent;
    rays_of(&seen, space->axis_of_others, part[k].o, part[k].d, reach, &extent);
    const Mask others = are_along(&seen) & have_slabs_of(&seen, r);
    see_along(r, others, &seen);
    space->others |= lanes_of(others) << FACET_LANES * k;
  }
  return along | space->others;
}

// Of the rays those that can be traced together. None if one cannot be used, if signs of their directions differ, or
// where they had better not.
APART uint packet_of(const PacketPart* part, float3 reach, PacketSpace* world) {
  const float3 towards = direction_of(part, FACET_MIDDLE_RAY);
  if (do_signs_differ(part, towards) || !can_go_together(part, reach)) return 0u;
  world->place = FACET_NONE;
  if (!space_of_packet(part, towards, reach, world)) return 0u;
  return have_one_axis(&world->beam) ? WHOLE_PACKET : mix_axes(part, reach, world);
}

// Those of a part's lanes among the packet's rays in `which`.
static inline Mask lanes_among(uint which, uint part) {
  const uint8 bit = (uint8)(1u, 2u, 4u, 8u, 16u, 32u, 64u, 128u);
  return ((uint8)(which >> FACET_LANES * part) & bit) != 0u;
}

// Rays that look for nothing.
static inline void leave_out(PacketPart* part, uint which) {
  for (uint k = 0u; k < FACET_PARTS; ++k) part[k].t = lanes_among(which, k) ? in_all(-INFINITY) : part[k].t;
}

#ifndef FACET_NO_INSTANCES

// Where rays meet a box, as box.h's box_interval.
static inline Intervals box_intervals(const Rays* r, float3 lo, float3 hi) {
  const Points d = r->inverse, n = r->near_offset, f = r->far_offset;
  Intervals i;
  i.near = larger_each(crossing_of(in_all(lo.x), in_all(hi.x), d.x, n.x), in_all(-INFINITY));
  i.near = larger_each(crossing_of(in_all(lo.y), in_all(hi.y), d.y, n.y), i.near);
  i.near = larger_each(crossing_of(in_all(lo.z), in_all(hi.z), d.z, n.z), i.near);
  i.far = smaller_each(crossing_of(in_all(hi.x), in_all(lo.x), d.x, f.x), in_all(INFINITY));
  i.far = smaller_each(crossing_of(in_all(hi.y), in_all(lo.y), d.y, f.y), i.far);
  i.far = smaller_each(crossing_of(in_all(hi.z), in_all(lo.z), d.z, f.z), i.far);
  return i;
}

// Takes the world's rays into an instance. False if they cannot go on together there.
static inline bool packet_in_instance(const Scene* s, uint place, const PacketPart* part,
                                      const PacketSpace* world, PacketSpace* inner) {
  __global const Instance* i = &s->instances[place];
  PacketPart inside[FACET_PARTS];  // o, d and tmin
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    inner->outer[k] = box_intervals(&world->rays[k], vec_global(i->lo), vec_global(i->hi));
    inside[k].o = map_points(i->object_from_world, part[k].o);
    inside[k].d = map_vectors(i->object_from_world, part[k].d);
    inside[k].tmin = part[k].tmin;
  }
  inner->place = place;
  const float3 towards = direction_of(inside, FACET_MIDDLE_RAY), reach = vec_global(i->reach);
  if (do_signs_differ(inside, towards) || !space_of_packet(inside, towards, reach, inner)) return false;
  return have_one_axis(&inner->beam) || mix_axes(inside, reach, inner) == WHOLE_PACKET;
}

#endif

#endif
