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

static inline Points one_point(float3 a) {
  Points c;
  c.x = in_all(a.x), c.y = in_all(a.y), c.z = in_all(a.z);
  return c;
}

static inline uint hit_triangles(const Space* s, Triangles t, Interval outer, float tmin, float tmax,
                                 bool count, TriangleHits* hits) {
  const Points p0 = points_of(t, 0), d = one_point(s->direction);
  const Points e1 = less(points_of(t, 1), p0), e2 = less(points_of(t, 2), p0);
  const Points p = cross_each(d, e2), o = less(one_point(s->o), p0);
  const Real inverse = 1.0f / dot_each(e1, p);
  const Real u = dot_each(o, p) * inverse;
  Mask met = (u >= 0.0f) & (u <= 1.0f);
  if (is_none(met)) return 0u;
  const Points q = cross_each(o, e1);
  const Real v = dot_each(d, q) * inverse;
  met &= (v >= 0.0f) & (u + v <= 1.0f);
  if (is_none(met)) return 0u;
  hits->t = dot_each(e2, q) * inverse;
  hits->is_front = inverse > 0.0f;
  hits->is_counted = met;
  return lanes_where(met & (hits->t >= tmin) & (hits->t <= tmax));
}

static inline float2 shares_of(const Space* s, Triangles t, uint lane) {
  const Points p0 = points_of(t, 0), d = one_point(s->direction);
  const Points e1 = less(points_of(t, 1), p0), e2 = less(points_of(t, 2), p0);
  const Points p = cross_each(d, e2), o = less(one_point(s->o), p0);
  const Real inverse = 1.0f / dot_each(e1, p);
  return (float2)(in_lane(dot_each(o, p) * inverse, lane),
                  in_lane(dot_each(d, cross_each(o, e1)) * inverse, lane));
}

#endif
)";

const char* const end_of_shares =
    "  return (float2)(in_lane(v / det, lane), in_lane(w / det, lane));\n}\n";

}  // namespace

kernel_edits with_direction() {
  return {
      {"triangle.h", "typedef struct {\n  float3 o;", "typedef struct {\n  float3 o, direction;"},
      {"triangle.h", "  s->o = o;\n", "  s->o = o;\n  s->direction = d;\n"}};
}

kernel_edits moller_trumbore_test() {
  return joined(
      {with_direction(),
       {{"triangle.h", "static inline uint hit_triangles(", "static inline uint unused_test("},
        {"triangle.h", "static inline float2 shares_of(", "static inline float2 unused_shares("},
        {"triangle.h", std::string(end_of_shares) + "\n#endif\n",
         std::string(end_of_shares) + moller_trumbore}}});
}

kernel_edits unpadded_slabs() {
  return {{"box.h", "const float3 p = pad * fabs(s.inverse);",
           "const float3 p = (float3)(0.0f * pad);"}};
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
