// The watertight ray-triangle test of Woop, Benthin and Wald (JCGT 2013), with exact signs.
//
// The sign of an edge function decides on which side of an edge the ray passes. It is a difference
// of two products, and it is computed to within 2 u of its own size (edge_function): so its sign is
// that of the exact difference, and 0 is 0. Two triangles that share an edge see opposite signs,
// so no ray passes between. The barycentric coordinates of a sliver come out right, too: rounded
// products would leave an error of u times the square of its length, where its area is that times
// its width (case 5 of `facet accuracy`: p99 of 47,000 ulps of t at an aspect of 10^6, against 3).
#ifndef FACET_TRIANGLE_H
#define FACET_TRIANGLE_H

#include "box.h"
#include "geometry.h"

// A ray in one space, with all that the tests need of it.
typedef struct {
  float3 o;
  Slabs slabs;
  uint axis;        // of the largest |d_i|
  bool is_turned;   // what turns counter-clockwise as seen by the ray turns clockwise once sheared
  float2 shear;     // d_x / d_z, d_y / d_z of the swapped direction
  float unit;       // 2^-e, e being the exponent of E (box.h): sheared z stay below 2
  float t_of_unit;  // 2^e / d_z: what a sheared z of 1 is in t
} Space;

// The main axis changes places with z, which takes fewer choices than moving all three in a circle.
static inline float3 swapped(uint axis, float3 a) {
  return (float3)(axis == 0u ? a.z : a.x, axis == 1u ? a.z : a.y,
                  axis == 0u ? a.x : axis == 1u ? a.y : a.z);
}

// False if the direction cannot be used: not finite, 0, or its largest component outside
// 2^-60 to 2^60; or an origin beyond 2^60. Such a ray meets nothing.
static inline bool space_of(Space* s, float3 o, float3 d, float3 reach) {
  const float3 a = fabs(d);
  s->axis = a.y > a.x ? (a.z > a.y ? 2u : 1u) : (a.z > a.x ? 2u : 0u);
  const float largest = larger(a.x, larger(a.y, a.z));
  const float3 p = fabs(o);
  // The negated comparison refuses a NaN in any component.
  if (!(a.x <= 1.152921504606847e18f && a.y <= 1.152921504606847e18f &&
        a.z <= 1.152921504606847e18f && largest >= 8.673617379884035e-19f &&
        p.x <= 1.152921504606847e18f && p.y <= 1.152921504606847e18f &&
        p.z <= 1.152921504606847e18f))
    return false;
  const float3 main = swapped(s->axis, d);
  s->o = o;
  s->is_turned = (main.z < 0.0f) != (s->axis != 2u);
  const float3 over_z = (float3)(main.x, main.y, 1.0f) / main.z;
  s->shear = over_z.xy;
  const float3 e = fabs(o) + reach;
  const float extent = larger(e.x, larger(e.y, e.z));
  const uint exponent = as_uint(larger(extent, 0x1p-60f)) & 0x7f800000u;
  s->unit = as_float(0x7f000000u - exponent);
  s->t_of_unit = over_z.z * as_float(exponent);
  s->slabs = slabs_of(o, d, extent, largest);
  return true;
}

// Corners relative to the ray's origin, the main axis in z's place.
static inline Points relative(const Space* s, Triangles t, int corner) {
  Points a;
#ifdef FACET_WIDE
  const float3 o = swapped(s->axis, s->o);
  __global const float* p = (__global const float*)(t + 3 * corner);
  a.x = *(Triangles)(p + (s->axis == 0u ? 2u * FACET_BLOCK : 0u)) - o.x;
  a.y = *(Triangles)(p + (s->axis == 1u ? 2u * FACET_BLOCK : FACET_BLOCK)) - o.y;
  a.z = *(Triangles)(p + s->axis * FACET_BLOCK) - o.z;
#else
  const float3 p = swapped(s->axis, t.corner[corner] - s->o);
  a.x = p.x;
  a.y = p.y;
  a.z = p.z;
#endif
  return a;
}

// The same, sheared so that the ray is the z axis from the origin on.
static inline Points sheared(const Space* s, Triangles t, int corner) {
  Points a = relative(s, t, corner);
  a.x = fma(in_all(-s->shear.x), a.z, a.x);
  a.y = fma(in_all(-s->shear.y), a.z, a.y);
  a.z = s->unit * a.z;
  return a;
}

// p.x * q.y - p.y * q.x by Kahan's method: within 2 u of it, so 0 only if it is 0 in the reals
// (Jeannerod, Louvet, Muller, Mathematics of Computation 82, 2013), underflow apart.
static inline Real edge_function(Points p, Points q) {
  const Real b = p.y * q.x;
  return fma(p.x, q.y, -b) + fma(-p.y, q.x, b);
}

// The same with rounded products: its sign is right or it is 0.
static inline Real rough_edge(Points p, Points q) { return p.x * q.y - p.y * q.x; }

// Whether the ray passes all edges on one side, or through them.
static inline Mask is_within(Real u, Real v, Real w) {
  const Real least = smaller_each(smaller_each(u, v), w), most = larger_each(larger_each(u, v), w);
  return (least >= 0.0f) | (most <= 0.0f);
}

// The sign of an edge function with ties broken by moving the ray by (eps, eps^2) in the plane
// (simulation of simplicity, Edelsbrunner and Muecke 1990): an edge belongs to exactly one of its
// triangles.
static inline Real edge_sign(Real e, Points p, Points q) {
  const Real along_x = p.y - q.y, along_y = q.x - p.x;
  const Real tie = along_x != 0.0f ? along_x : along_y;
  return e != 0.0f ? e : tie;
}

typedef struct {
  Real t;
  Mask is_front;    // the ray enters through the side on which the corners turn counter-clockwise
  Mask is_counted;  // this triangle, not a neighbour, owns the edge or corner that is met
} TriangleHits;

// Along one axis, where the ray enters, or leaves, the triangles' boxes.
static inline Real crossing_of(Real lo, Real hi, float inverse, bool is_lower, float offset) {
  return fma(is_lower ? lo : hi, in_all(inverse), in_all(offset));
}

// Holds t to the interval of the triangle's own box, cut with `outer`: so no node that leads to the
// triangle can have been left out (box.h). False where the two have nothing in common. It is
// hardly ever needed.
static inline Mask hold_to_boxes(const Space* s, Triangles p, Interval outer, Real* t) {
  const Points p0 = points_of(p, 0), p1 = points_of(p, 1), p2 = points_of(p, 2);
  const Points lo = smallest_of(p0, p1, p2), hi = largest_of(p0, p1, p2);
  const float3 d = s->slabs.inverse, n = s->slabs.near_offset, f = s->slabs.far_offset;
  Real near = in_all(outer.near), far = in_all(outer.far);
  near = larger_each(crossing_of(lo.x, hi.x, d.x, d.x > 0.0f, n.x), near);
  near = larger_each(crossing_of(lo.y, hi.y, d.y, d.y > 0.0f, n.y), near);
  near = larger_each(crossing_of(lo.z, hi.z, d.z, d.z > 0.0f, n.z), near);
  far = smaller_each(crossing_of(lo.x, hi.x, d.x, !(d.x > 0.0f), f.x), far);
  far = smaller_each(crossing_of(lo.y, hi.y, d.y, !(d.y > 0.0f), f.y), far);
  far = smaller_each(crossing_of(lo.z, hi.z, d.z, !(d.z > 0.0f), f.z), far);
  const Real after = *t < near ? near : *t;
  // One zero: that of a face may have either sign.
  *t = (after > far ? far : after) + 0.0f;
  return near <= far;
}

// The lanes of the triangles that the ray meets with t in tmin..tmax; the edges belong to the triangle.
// t lies in the interval of the triangle's own box and in `outer`, that of its instance's box in the world.
//
// It does so by itself, unless an underflow or an instance's maps come between. With u, v, w as they
// come out, each within 2u of the edge function of the sheared corners, b = u / (u+v+w) and so on are
// shares of a point P of the triangle, in its box. The sheared corners are off by 5u E, and their mean
// by these shares would be 0 but for 4u E, by the identity of the edge functions: P lies within 9u E
// of the ray where P's distance along the main axis is t. t itself is off by 9u E (each z by u, the sum
// and its quotient by 6u, 1 / d_z and its product by 2u). The slabs are off by 4u E: together 22u E, on
// any axis, whatever the angle, for an error of t moves P within the triangle. The pad is 24u E.
// Nothing overflows: x and y are below 2^62, edge functions below 2^125, z at most 2. Edge
// functions have lost no more than 2^-147 to underflow: with |det| >= 2^-120 that is below u E / 2, and
// with |top| >= 2^-100 that of its products is below u |t|.
static inline uint hit_triangles(const Space* s, Triangles p, Interval outer, float tmin, float tmax,
                                 bool count, TriangleHits* hits) {
  const Points a = sheared(s, p, 0), b = sheared(s, p, 1), c = sheared(s, p, 2);
  // Most triangles that are tested are passed by: these need no more than the signs.
  const Mask near_by = is_within(rough_edge(c, b), rough_edge(a, c), rough_edge(b, a));
  if (is_none(near_by)) return 0u;
  const Real u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const Real det = (u + v) + w;
  Mask met = is_within(u, v, w) & (det != 0.0f);
  if (is_none(met)) return 0u;
  const Real top = fma(w, c.z, fma(v, b.z, u * a.z));
  Real t = top / det * s->t_of_unit;
  // |top| >= 2^-100 and |det| >= 2^-120. Without instances `outer` holds everything.
  Mask is_sure = smaller_each(fabs(top), fabs(det) * 0x1p20f) >= 0x1p-100f;
#ifndef FACET_NO_INSTANCES
  is_sure &= (t >= outer.near) & (t <= outer.far);
#endif
  const Mask is_held = met & !is_sure;
  if (!is_none(is_held)) {
    Real held = t;
    met &= hold_to_boxes(s, p, outer, &held) | !is_held;
    t = is_held ? held : t;
  }
  hits->t = t;
  if (count) {
    const Real su = edge_sign(u, c, b), sv = edge_sign(v, a, c), sw = edge_sign(w, b, a);
    hits->is_counted = ((su > 0.0f) & (sv > 0.0f) & (sw > 0.0f)) | ((su < 0.0f) & (sv < 0.0f) & (sw < 0.0f));
    hits->is_front = s->is_turned ? !(su > 0.0f) : su > 0.0f;
  }
  return lanes_where(met & (t >= tmin) & (t <= tmax));
}

// Where the ray meets a triangle that hit_triangles has accepted: the hit's u and v, the shares of p1
// and p2. Computed anew for the one triangle that is left when a search has ended.
static inline float2 shares_of(const Space* s, Triangles p, uint lane) {
  const Points a = sheared(s, p, 0), b = sheared(s, p, 1), c = sheared(s, p, 2);
  const Real u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const Real det = (u + v) + w;
  return (float2)(in_lane(v / det, lane), in_lane(w / det, lane));
}

#endif
