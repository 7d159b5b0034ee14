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

static inline Points first_corner(Triangles t, const Rays* r, Points* e1, Points* e2) {
  const Points p0 = swapped_corner(t, 0, r->axis);
  *e1 = less(swapped_corner(t, 1, r->axis), p0);
  *e2 = less(swapped_corner(t, 2, r->axis), p0);
  return p0;
}

INLINED Mask hit_triangles(const Rays* r, GEOMETRY positions, Triangles t, Intervals outer, Real tmin, Real tmax,
                           bool count, TriangleHits* hits) {
  Points e1, e2;
  const Points p0 = first_corner(t, r, &e1, &e2), d = r->direction;
  const Points p = cross_each(d, e2), o = less(r->o, p0);
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
  hits->is_front = r->axis == 2u ? inverse > 0.0f : inverse < 0.0f;
  hits->is_counted = met;
  return met & (hits->t >= tmin) & (hits->t <= tmax);
}

static inline float2 shares_in_slot(const Space* s, GEOMETRY positions, uint slot) {
  const Rays r = in_all_lanes(s);
  Points e1, e2;
  const Points p0 = first_corner(triangles_from(positions, slot / FACET_LANES), &r, &e1, &e2);
  const Points p = cross_each(r.direction, e2), o = less(r.o, p0);
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
  return {{"space.h", "  float3 o;\n", "  float3 o, direction;\n"},
          {"space.h", "  s->o = o;\n", "  s->o = o;\n  s->direction = d;\n"},
          {"space.h", "  Points o;  // the main", "  Points direction, o;  // the main"},
          {"space.h", "  r.shear_x = ",
           "  r.direction = point_in_all(swapped(s->axis, s->direction));\n  r.shear_x = "},
          {"space.h", "  r->shear_x = ", "  r->direction = main;\n  r->shear_x = "},
          {"space.h", "  s.axis = r->axis;\n",
           "  s.direction = swapped(r->axis, point_in_lane(&r->direction, lane));\n  s.axis = "
           "r->axis;\n"},
          // 1 / d_z is t_of_unit * unit, and rounded.
          {"stream.h", "  r.axis = ray->axis",
           "  r.direction.z = 1.0f / (r.t_of_unit * r.unit);\n"
           "  r.direction.x = r.shear_x * r.direction.z;\n"
           "  r.direction.y = r.shear_y * r.direction.z;\n  r.axis = ray->axis"}};
}

kernel_edits moller_trumbore_test() {
  return joined({with_direction(),
                 {{"triangle.h", "INLINED Mask hit_triangles(", "static inline Mask unused_test("},
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
