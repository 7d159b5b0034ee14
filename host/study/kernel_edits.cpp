#include "study/kernel_edits.hpp"

#include <string>

namespace facet::study {
namespace {

const char* const moller_trumbore = R"(
static inline Real dot_each(Points a, Points b) { return (a.x * b.x + a.y * b.y) + a.z * b.z; }

static inline Points cross_each(Points a, Points b) {
  Points c;
  c.x = a.y * b.z - a.z * b.y, c.y = a.z * b.x - a.x * b.z, c.z = a.x * b.y - a.y * b.x;
  return c;
}

static inline Points less(Points a, Points b) {
  Points c;
  c.x = a.x - b.x, c.y = a.y - b.y, c.z = a.z - b.z;
  return c;
}

INLINED Points first_corner(Triangles t, const Rays* r, Points* e1, Points* e2) {
  const Points p0 = swapped_corner(t, 0, r->order);
  *e1 = less(swapped_corner(t, 1, r->order), p0);
  *e2 = less(swapped_corner(t, 2, r->order), p0);
  return p0;
}

// Several lanes are asked but once.
static inline Mask may_be_within(const Rays* r, Triangles t) { return (Mask)(-1); }

INLINED Mask hit_triangles(const Rays* r, Triangles t, Intervals outer, Real tmin, Real tmax, bool count,
                           TriangleHits* hits) {
  Points e1, e2;
  hits->is_doubtful = (Mask)(0);
  const Points p0 = first_corner(t, r, &e1, &e2), d = r->direction;
  const Points p = cross_each(d, e2), o = less(r->origin, p0);
  const Real inverse = 1.0f / dot_each(e1, p);
  const Real u = dot_each(o, p) * inverse;
  Mask met = (u >= 0.0f) & (u <= 1.0f);
  if (is_none(met)) return met;
  const Points q = cross_each(o, e1);
  const Real v = dot_each(d, q) * inverse;
  met &= (v >= 0.0f) & (u + v <= 1.0f);
  if (is_none(met)) return met;
  hits->t = dot_each(e2, q) * inverse;
  hits->v = u, hits->w = v, hits->det = in_all(1.0f);
  const Mask is_swapped = r->is_turned ? !(d.z < 0.0f) : d.z < 0.0f;
  hits->is_front = is_swapped ? inverse < 0.0f : inverse > 0.0f;
  hits->is_counted = met;
  return met & (hits->t >= tmin) & (hits->t <= tmax);
}

static inline float2 shares_in_slot(const Space* s, GEOMETRY positions, uint slot) {
  const Rays r = in_all_lanes(s);
  Points e1, e2;
  const Points p0 = first_corner(triangles_from(positions, slot / FACET_LANES), &r, &e1, &e2);
  const Points p = cross_each(r.direction, e2), o = less(r.origin, p0);
  const Real inverse = 1.0f / dot_each(e1, p);
  return (float2)(in_lane(dot_each(o, p) * inverse, slot % FACET_LANES),
                  in_lane(dot_each(r.direction, cross_each(o, e1)) * inverse, slot % FACET_LANES));
}

#endif
)";

const char* const end_of_shares =
    "  return (float2)(in_lane(v / det, slot % FACET_LANES), in_lane(w / det, slot % "
    "FACET_LANES));\n}\n";

}  // namespace

kernel_edits with_direction() {
  return {{"space.h", "  float3 o;  ", "  float3 direction, origin, o;"},
          {"space.h", "  s->o = s->unit * o;\n",
           "  s->o = s->unit * o;\n  s->direction = d;\n  s->origin = o;\n"},
          {"space.h", "  Points o;  //", "  Points direction, origin, o;  //"},
          {"space.h", "  r.shear_x = ",
           "  r.direction = point_in_all(swapped(s->axis, s->direction));\n"
           "  r.origin = point_in_all(swapped(s->axis, s->origin));\n  r.shear_x = "},
          {"space.h", "  r->shear_x = main.x",
           "  r->direction = main;\n  r->origin = swapped_points(axis, o);\n  r->shear_x = main.x"},
          {"space.h", "  s.axis = axis;\n",
           "  s.direction = swapped(axis, point_in_lane(&r->direction, lane));\n"
           "  s.origin = swapped(axis, point_in_lane(&r->origin, lane));\n  s.axis = axis;\n"},
          {"space.h", "  r->o = chosen_points(others, seen->o, r->o);\n",
           "  r->o = chosen_points(others, seen->o, r->o);\n"
           "  r->origin = chosen_points(others, seen->origin, r->origin);\n"
           "  r->direction = chosen_points(others, seen->direction, r->direction);\n"},
          // 1 / d_z is t_of_unit * unit, and rounded; the origin was scaled by a power of two.
          {"stream.h", "  r.order.x = ray->order[0]",
           "  r.origin = scaled_points(1.0f / r.unit, r.o);\n"
           "  r.direction.z = 1.0f / (r.t_of_unit * r.unit);\n"
           "  r.direction.x = r.shear_x * r.direction.z;\n"
           "  r.direction.y = r.shear_y * r.direction.z;\n  r.order.x = ray->order[0]"}};
}

kernel_edits moller_trumbore_test() {
  return joined(
      {with_direction(),
       {{"triangle.h", "INLINED Mask hit_triangles(", "static inline Mask unused_test("},
        {"triangle.h", "INLINED Mask may_be_within(", "static inline Mask unused_within("},
        {"triangle.h", "static inline float2 shares_in_slot(",
         "static inline float2 unused_shares("},
        {"triangle.h", std::string(end_of_shares) + "\n#endif\n",
         std::string(end_of_shares) + moller_trumbore}}});
}

kernel_edits unpadded_slabs() {
  return {{"box.h", "const float3 p = pad * fabs(s.inverse);",
           "const float3 p = (float3)(0.0f * pad);"},
          {"space.h", "const Real p = pad * fabs(*inverse)", "const Real p = in_all(0.0f)"}};
}

kernel_edits always_held() {
  return {
      {"triangle.h", "hits->is_doubtful = is_hit & is_doubtful;", "hits->is_doubtful = is_hit;"}};
}

kernel_edits rounded_edges() {
  return {{"triangle.h", "return fma(p.x, q.y, -b) + fma(-p.y, q.x, b);", "return p.x * q.y - b;"}};
}

kernel_edits contracted() {
  return {{"vec.h", "#pragma OPENCL FP_CONTRACT OFF", "#pragma OPENCL FP_CONTRACT ON"}};
}

kernel_edits joined(std::initializer_list<kernel_edits> parts) {
  kernel_edits all;
  for (const kernel_edits& p : parts) all.insert(all.end(), p.begin(), p.end());
  return all;
}

}  // namespace facet::study
