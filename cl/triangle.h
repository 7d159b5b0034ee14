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

#include "geometry.h"
#include "space.h"

// Corners relative to the rays' origins, the main axis in z's place.
static inline Points relative(const Rays* r, Triangles t, int corner) {
  Points a = swapped_corner(t, corner, r->axis);
  a.x = a.x - r->o.x;
  a.y = a.y - r->o.y;
  a.z = a.z - r->o.z;
  return a;
}

// The same, sheared so that each ray is the z axis from the origin on.
static inline Points sheared(const Rays* r, Triangles t, int corner) {
  Points a = relative(r, t, corner);
  a.x = fma(-r->shear_x, a.z, a.x);
  a.y = fma(-r->shear_y, a.z, a.y);
  a.z = r->unit * a.z;
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
  Real v, w, det;   // shares of the second and third corner, in units of det
  Mask is_front;    // the ray enters through the side on which the corners turn counter-clockwise
  Mask is_counted;  // this triangle, not a neighbour, owns the edge or corner that is met
} TriangleHits;

// Along one axis, where a ray enters a triangle's box, or with the other side first leaves it.
static inline Real crossing_of(Real lo, Real hi, Real inverse, Real offset) {
  return fma(inverse > 0.0f ? lo : hi, inverse, offset);
}

// Holds t to the interval of the triangle's own box, cut with `outer`: so no node that leads to the
// triangle can have been left out (box.h). False where the two have nothing in common. It is
// hardly ever needed.
static inline Mask hold_to_boxes(const Rays* r, Triangles p, Intervals outer, Real* t) {
  Points lo, hi;
  bounds_of(p, &lo, &hi);
  const Points d = r->inverse, n = r->near_offset, f = r->far_offset;
  Real near = outer.near, far = outer.far;
  near = larger_each(crossing_of(lo.x, hi.x, d.x, n.x), near);
  near = larger_each(crossing_of(lo.y, hi.y, d.y, n.y), near);
  near = larger_each(crossing_of(lo.z, hi.z, d.z, n.z), near);
  far = smaller_each(crossing_of(hi.x, lo.x, d.x, f.x), far);
  far = smaller_each(crossing_of(hi.y, lo.y, d.y, f.y), far);
  far = smaller_each(crossing_of(hi.z, lo.z, d.z, f.z), far);
  const Real after = *t < near ? near : *t;
  // One zero: that of a face may have either sign.
  *t = (after > far ? far : after) + 0.0f;
  return near <= far;
}

// The lanes whose rays meet their triangles with t in tmin..tmax; the edges belong to the triangle. A literal:
// `count`, whether is_front and is_counted are asked for. t lies in the interval of the triangle's own box and in
// `outer`, that of its instance's box in the world.
//
// It does so by itself, unless an underflow or an instance's maps come between. With u, v, w as they
// come out, each within 2u of the edge function of the sheared corners, b = u / (u+v+w) and so on are
// shares of a point P of the triangle, in its box. The sheared corners are off by 5u E, and their mean
// by these shares would be 0 but for 4u E, by the identity of the edge functions: P lies within 9u E
// of the ray where P's distance along the main axis is t. t itself is off by 9u E (each z by u, the sum
// and its quotient by 6u, 1 / d_z and its product by 2u). The slabs are off by 4u E: together 22u E, on
// any axis, whatever the angle, for an error of t moves P within the triangle. The pad is 24u E.
// Nothing overflows: x and y are below 2^62, edge functions below 2^125, z at most 2. Edge
// functions have lost no more than 2^-147 to underflow: with |det| >= 2^-100 that is below u E / 2, and
// with |top| >= 2^-100 that of its products is below u |t|.
INLINED Mask hit_triangles(const Rays* r, GEOMETRY positions, Triangles p, Intervals outer, Real tmin, Real tmax,
                           bool count, TriangleHits* hits) {
  const Points a = sheared(r, p, 0), b = sheared(r, p, 1), c = sheared(r, p, 2);
  // Most of many lanes' triangles are passed by: these need no more than the signs.
  if (FACET_LANES > 1u) {
    const Mask near_by = is_within(rough_edge(c, b), rough_edge(a, c), rough_edge(b, a));
    if (is_none(near_by)) return near_by;
  }
  const Real u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const Real det = (u + v) + w;
  Mask met = is_within(u, v, w);
  if (is_none(met)) return met;
  const Real top = fma(w, c.z, fma(v, b.z, u * a.z));
  Real t = top / det * r->t_of_unit;
  // |top| >= 2^-100 and |det| >= 2^-100, so that it is not 0. Without instances `outer` holds everything.
  Mask is_sure = smaller_each(fabs(top), fabs(det)) >= 0x1p-100f;
#ifndef FACET_NO_INSTANCES
  is_sure &= (t >= outer.near) & (t <= outer.far);
#endif
  const Mask is_held = met & !is_sure;
  if (!is_none(is_held)) {
    Real held = t;
    met &= (hold_to_boxes(r, read_again(positions, p), outer, &held) & (det != 0.0f)) | !is_held;
    t = is_held ? held : t;
  }
  hits->t = t;
  hits->v = v, hits->w = w, hits->det = det;
  if (count) {
    const Real su = edge_sign(u, c, b), sv = edge_sign(v, a, c), sw = edge_sign(w, b, a);
    hits->is_counted = ((su > 0.0f) & (sv > 0.0f) & (sw > 0.0f)) | ((su < 0.0f) & (sv < 0.0f) & (sw < 0.0f));
    hits->is_front = r->is_turned ? !(su > 0.0f) : su > 0.0f;
  }
  return met & (t >= tmin) & (t <= tmax);
}

// Where the ray meets the triangle in a slot, which hit_triangles has accepted: the hit's u and v, the shares
// of p1 and p2. Computed anew for the one triangle that is left when a search has ended.
static inline float2 shares_in_slot(const Space* s, GEOMETRY positions, uint slot) {
  const Rays ray = in_all_lanes(s), *r = &ray;
  const Triangles p = triangles_from(positions, slot / FACET_LANES);
  const Points a = sheared(r, p, 0), b = sheared(r, p, 1), c = sheared(r, p, 2);
  const Real u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const Real det = (u + v) + w;
  return (float2)(in_lane(v / det, slot % FACET_LANES), in_lane(w / det, slot % FACET_LANES));
}

#endif
