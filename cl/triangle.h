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

// Corners relative to the rays' origins, in units of 2^e (space.h: these products are exact), the main axis in z's
// place, sheared so that each ray is the z axis from the origin on.
static inline Points sheared(const Rays* r, Triangles t, int corner) {
  Points a = swapped_corner(t, corner, r->order);
  a.x = fma(r->unit, a.x, -r->o.x);
  a.y = fma(r->unit, a.y, -r->o.y);
  a.z = fma(r->unit, a.z, -r->o.z);
  a.x = fma(-r->shear_x, a.z, a.x);
  a.y = fma(-r->shear_y, a.z, a.y);
  return a;
}

// p.x * q.y - p.y * q.x by Kahan's method: within 2 u of it, so 0 only if it is 0 in the reals
// (Jeannerod, Louvet, Muller, Mathematics of Computation 82, 2013), underflow apart.
static inline Real edge_function(Points p, Points q) {
  const Real b = p.y * q.x;
  return fma(p.x, q.y, -b) + fma(-p.y, q.x, b);
}

// Whether the ray passes all edges on one side, or through them.
static inline Mask is_within(Real u, Real v, Real w) {
  const Real least = smaller_each(smaller_each(u, v), w), most = larger_each(larger_each(u, v), w);
  return (least >= 0.0f) | (most <= 0.0f);
}

// False only where is_within says so of the edge functions: a product that is not less than another is not less when
// both are rounded. Most triangles are passed by, and comparisons are enough for that.
INLINED Mask may_be_within(const Rays* r, Triangles p) {
  const Points a = sheared(r, p, 0), b = sheared(r, p, 1), c = sheared(r, p, 2);
  const Real u0 = c.x * b.y, u1 = c.y * b.x, v0 = a.x * c.y, v1 = a.y * c.x, w0 = b.x * a.y, w1 = b.y * a.x;
  return ((u0 >= u1) & (v0 >= v1) & (w0 >= w1)) | ((u0 <= u1) & (v0 <= v1) & (w0 <= w1));
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
  Mask is_doubtful; // the ray passes within the edges, and t is to be held to boxes first
} TriangleHits;

// Along one axis, where a ray enters a triangle's box, or with the other side first leaves it.
static inline Real crossing_of(Real lo, Real hi, Real inverse, Real offset) {
  return fma(inverse > 0.0f ? lo : hi, inverse, offset);
}

// Holds t to the interval of the triangle's own box, cut with `outer`: so no node that leads to the
// triangle can have been left out (box.h). False where the two have nothing in common, or for a triangle that
// begins with one corner twice (blocks.h). It is hardly ever needed.
static inline Mask hold_to_boxes(const Rays* r, Triangles p, Intervals outer, Real* t) {
  Points lo, hi;
  bounds_of(p, &lo, &hi);
  const Points p0 = points_of(p, 0), p1 = points_of(p, 1);
  const Mask have_side = (p0.x != p1.x) | (p0.y != p1.y) | (p0.z != p1.z);
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
  return have_side & (near <= far);
}

// The lanes whose rays meet their triangles with t in tmin..tmax; the edges belong to the triangle. A literal:
// `count`, whether is_front and is_counted are asked for. t lies in the interval of the triangle's own box and in
// `outer`, that of its instance's box in the world. Of those that are doubtful nothing is said: the caller calls
// settle_doubts if there are any, so that few instructions come before the branch that most triangles take.
//
// It does so by itself, unless an underflow or an instance's maps come between. With u, v, w as they
// come out, each within 2u of the edge function of the sheared corners, b = u / (u+v+w) and so on are
// shares of a point P of the triangle, in its box. The sheared corners are off by 5u E, and their mean
// by these shares would be 0 but for 4u E, by the identity of the edge functions: P lies within 9u E
// of the ray where P's distance along the main axis is t. t itself is off by 9u E (each z by u, the sum
// and its quotient by 6u, 1 / d_z and its product by 2u). The slabs are off by 4u E: together 22u E, on
// any axis, whatever the angle, for an error of t moves P within the triangle. The pad is 24u E.
// Nothing overflows: in units of 2^e, which is at most E and more than E / 2, z are below 2, x and y below 4, edge
// functions below 32. To underflow edge functions have lost no more than 2^-147, and the top 2^-145: with |det| >= 2^-63
// P moves by less than 2^-80 E, and t by as much. (Where all of a space and the ray's origin lie within 2^-118 of 0, t may
// move by more than the pad, for space_of takes E for 2^-60 then.)
INLINED Mask hit_triangles(const Rays* r, Triangles p, Intervals outer, Real tmin, Real tmax, bool count,
                           TriangleHits* hits) {
  const Points a = sheared(r, p, 0), b = sheared(r, p, 1), c = sheared(r, p, 2);
  const Real u = edge_function(c, b), v = edge_function(a, c), w = edge_function(b, a);
  const Real det = (u + v) + w;
  const Mask is_hit = is_within(u, v, w);
  // A branch is worth it for one alone.
  if (FACET_LANES == 1u && is_none(is_hit)) {
    hits->is_doubtful = is_hit;
    return is_hit;
  }
  const Real top = fma(w, c.z, fma(v, b.z, u * a.z));
  // The product, with one zero.
  const Real t = fma(top / det, r->t_of_unit, in_all(0.0f));
  Mask is_doubtful = is_tiny(det);
#ifndef FACET_NO_INSTANCES
  // Else `outer` holds everything.
  is_doubtful |= (t < outer.near) | (t > outer.far);
#endif
  hits->t = t;
  hits->is_doubtful = is_hit & is_doubtful;
  hits->v = v, hits->w = w, hits->det = det;
  if (count) {
    const Real su = edge_sign(u, c, b), sv = edge_sign(v, a, c), sw = edge_sign(w, b, a);
    hits->is_counted = ((su > 0.0f) & (sv > 0.0f) & (sw > 0.0f)) | ((su < 0.0f) & (sv < 0.0f) & (sw < 0.0f));
    hits->is_front = r->is_turned ? !(su > 0.0f) : su > 0.0f;
  }
  return is_hit & (t >= tmin) & (t <= tmax);
}

// The lanes that meet their triangles, given those that do as hit_triangles has it.
INLINED Mask settle_doubts(const Rays* r, GEOMETRY positions, Triangles p, Intervals outer, Real tmin, Real tmax,
                           Mask met, TriangleHits* hits) {
  const Mask is_held = hits->is_doubtful;
  if (is_none(is_held)) return met;
  Real held = hits->t;
  const Mask is_kept = hold_to_boxes(r, read_again(positions, p), outer, &held) & (hits->det != 0.0f);
  hits->t = is_held ? held : hits->t;
  return is_held ? is_kept & (held >= tmin) & (held <= tmax) : met;
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
