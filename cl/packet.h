// Rays that are traced together while they stay close, FACET_PACKET of them: the lanes of several vectors.
#ifndef FACET_PACKET_H
#define FACET_PACKET_H

#include "beam.h"
#include "query.h"

#define FACET_PARTS (FACET_PACKET / FACET_LANES)

// Eight of the rays, and what each has met so far.
typedef struct {
  Rays rays;
  Real tmin;
  Real t;          // tmax, or the best hit's; -INFINITY once a search for any hit has one
  Real v, w, det;  // of the best hit (triangle.h: TriangleHits); det 0: not known
  uint8 slot;      // of the best hit; FACET_NONE
} PacketPart;

// Eight rows of eight, columns for rows.
static inline void transpose(Real a[8]) {
  const Real b0 = (Real)(a[0].even, a[1].even), b4 = (Real)(a[0].odd, a[1].odd);
  const Real b1 = (Real)(a[2].even, a[3].even), b5 = (Real)(a[2].odd, a[3].odd);
  const Real b2 = (Real)(a[4].even, a[5].even), b6 = (Real)(a[4].odd, a[5].odd);
  const Real b3 = (Real)(a[6].even, a[7].even), b7 = (Real)(a[6].odd, a[7].odd);
  const Real c0 = (Real)(b0.even, b1.even), c4 = (Real)(b0.odd, b1.odd);
  const Real c1 = (Real)(b2.even, b3.even), c5 = (Real)(b2.odd, b3.odd);
  const Real c2 = (Real)(b4.even, b5.even), c6 = (Real)(b4.odd, b5.odd);
  const Real c3 = (Real)(b6.even, b7.even), c7 = (Real)(b6.odd, b7.odd);
  a[0] = (Real)(c0.even, c1.even), a[4] = (Real)(c0.odd, c1.odd);
  a[1] = (Real)(c2.even, c3.even), a[5] = (Real)(c2.odd, c3.odd);
  a[2] = (Real)(c4.even, c5.even), a[6] = (Real)(c4.odd, c5.odd);
  a[3] = (Real)(c6.even, c7.even), a[7] = (Real)(c6.odd, c7.odd);
}

// Whether on each axis a sign is another than the first ray's.
static inline bool do_signs_differ(Points d, float3 first) {
  const Mask x = as_int8(d.x) ^ as_int(first.x), y = as_int8(d.y) ^ as_int(first.y),
             z = as_int8(d.z) ^ as_int(first.z);
  return !is_none((x | y | z) < 0);
}

// Offsets as seen from the centre.
static inline Points moved_to(float3 centre, Points offset, Points inverse) {
  Points p;
  p.x = fma(in_all(centre.x), inverse.x, offset.x);
  p.y = fma(in_all(centre.y), inverse.y, offset.y);
  p.z = fma(in_all(centre.z), inverse.z, offset.z);
  return p;
}

static inline Beam beam_of(const PacketPart* part, float3 centre, float extent) {
  Points least = part[0].rays.inverse, most = least;
  Points near = moved_to(centre, part[0].rays.near_offset, least);
  Points far = moved_to(centre, part[0].rays.far_offset, least);
  Real tmin = part[0].tmin;
  for (uint k = 1u; k < FACET_PARTS; ++k) {
    const Rays* r = &part[k].rays;
    least = smaller_points(r->inverse, least);
    most = larger_points(r->inverse, most);
    near = smaller_points(moved_to(centre, r->near_offset, r->inverse), near);
    far = larger_points(moved_to(centre, r->far_offset, r->inverse), far);
    tmin = smaller_each(part[k].tmin, tmin);
  }
  Beam b;
  b.x = beam_axis(centre.x, least.x, most.x, near.x, far.x, extent);
  b.y = beam_axis(centre.y, least.y, most.y, near.y, far.y, extent);
  b.z = beam_axis(centre.z, least.z, most.z, near.z, far.z, extent);
  b.tmin = least_of(tmin);
  return b;
}

static inline float best_of(const PacketPart* part) {
  Real t = part[0].t;
  for (uint k = 1u; k < FACET_PARTS; ++k) t = larger_each(part[k].t, t);
  return most_of(t);
}

// A packet is worth it where its rays start close to one another: within this share of the space's size.
#ifndef FACET_PACKET_WIDTH
#define FACET_PACKET_WIDTH 0.0625f
#endif

// Takes FACET_PACKET rays from a buffer. False if they cannot be traced together: one cannot be used, or
// meets nothing from the start; the signs or main axes of their directions differ; they start too far from
// one another.
static inline bool packet_of(__global const Ray* rays, float3 reach, PacketPart* part, Beam* b) {
  Points o[FACET_PARTS], d[FACET_PARTS], least, most;
  const float3 centre = vec_global(rays->origin), first = vec_global(rays->direction);
  uint usable = (1u << FACET_LANES) - 1u;
  Real extent = in_all(0.0f), offsets = in_all(0.0f);
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    __global const Real* from = (__global const Real*)rays + FACET_LANES * k;
    Real a[8] = {from[0], from[1], from[2], from[3], from[4], from[5], from[6], from[7]};
    transpose(a);
    o[k].x = a[0], o[k].y = a[1], o[k].z = a[2];
    d[k].x = a[4], d[k].y = a[5], d[k].z = a[6];
    if (do_signs_differ(d[k], first)) return false;
    part[k].tmin = a[3] < 0.0f ? in_all(0.0f) : a[3];
    part[k].t = a[7];
    part[k].v = part[k].w = part[k].det = in_all(0.0f);
    part[k].slot = (uint8)(FACET_NONE);
    usable &= lanes_of(part[k].tmin <= part[k].t);
    least = k == 0u ? o[0] : smaller_points(o[k], least);
    most = k == 0u ? o[0] : larger_points(o[k], most);
  }
  const float3 width = (float3)(most_of(most.x) - least_of(least.x), most_of(most.y) - least_of(least.y),
                                most_of(most.z) - least_of(least.z));
  if (!(larger(width.x, larger(width.y, width.z)) <=
        FACET_PACKET_WIDTH * larger(reach.x, larger(reach.y, reach.z))))
    return false;
  const uint axis = main_axis(first);
  for (uint k = 0u; k < FACET_PARTS; ++k) {
    Real e;
    Rays* r = &part[k].rays;
    rays_of(r, axis, o[k], d[k], reach, &e);
    extent = larger_each(e, extent);
    offsets += (r->near_offset.x + r->near_offset.y) + r->near_offset.z;
  }
  // A sum is NaN or infinite where a term is, and an offset where o, d or their product is, but for an infinite
  // d: its inverse is 0, which are_rays_usable finds.
  usable &= lanes_of(fabs(offsets) < INFINITY);
  if (usable != (1u << FACET_LANES) - 1u) return false;
  *b = beam_of(part, centre, most_of(extent));
  return are_rays_usable(b, axis, most_of(extent));
}

#endif
