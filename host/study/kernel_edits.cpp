#include "study/kernel_edits.hpp"

#include <string>

namespace facet::study {
namespace {

const char* const moller_trumbore = R"(
static inline bool hit_triangle(const Space* s, float3 p0, float3 p1, float3 p2, Interval outer,
                                float tmin, float tmax, bool count, TriangleHit* hit) {
  const float3 e1 = p1 - p0, e2 = p2 - p0, p = cross3(s->direction, e2), o = s->o - p0;
  const float inverse = 1.0f / dot3(e1, p);
  const float u = dot3(o, p) * inverse;
  if (!(u >= 0.0f && u <= 1.0f)) return false;
  const float3 q = cross3(o, e1);
  const float v = dot3(s->direction, q) * inverse;
  if (!(v >= 0.0f && u + v <= 1.0f)) return false;
  const float t = dot3(e2, q) * inverse;
  if (!(t >= tmin && t <= tmax)) return false;
  hit->t = t;
  hit->is_front = inverse > 0.0f;
  hit->is_counted = true;
  return true;
}

static inline float2 shares_of(const Space* s, float3 p0, float3 p1, float3 p2) {
  const float3 e1 = p1 - p0, e2 = p2 - p0, p = cross3(s->direction, e2), o = s->o - p0;
  const float inverse = 1.0f / dot3(e1, p);
  return (float2)(dot3(o, p) * inverse, dot3(s->direction, cross3(o, e1)) * inverse);
}

#endif
)";

}  // namespace

kernel_edits with_direction() {
  return {
      {"triangle.h", "typedef struct {\n  float3 o;", "typedef struct {\n  float3 o, direction;"},
      {"triangle.h", "  s->o = o;\n", "  s->o = o;\n  s->direction = d;\n"}};
}

kernel_edits moller_trumbore_test() {
  return joined(
      {with_direction(),
       {{"triangle.h", "static inline bool hit_triangle(", "static inline bool unused_test("},
        {"triangle.h", "static inline float2 shares_of(", "static inline float2 unused_shares("},
        {"triangle.h", "  return (float2)(v / det, w / det);\n}\n\n#endif\n",
         std::string("  return (float2)(v / det, w / det);\n}\n") + moller_trumbore}}});
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
