#include "study/variants.hpp"

namespace facet::study {
namespace {

using edits = std::vector<tracer::kernel_edit>;

/// The test of Moeller and Trumbore (Journal of Graphics Tools 2, 1997), leaving as soon as it can.
const char* const moller_trumbore_test = R"(
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
  hit->v = u;
  hit->w = v;
  hit->det = 1.0f;
  hit->is_front = inverse > 0.0f;
  hit->is_counted = true;
  return true;
}

#endif
)";

edits unpadded() {
  return {{"box.h", "const float3 p = pad * fabs(s.inverse);", "const float3 p = (float3)(0.0f);"}};
}

edits unordered() {
  return {{"traverse.h", "if (hit.t == q->t && (", "if (hit.t >= q->t || (false && "}};
}

edits unheld() {
  return {{"triangle.h", "if (!hold_to_boxes(s, p0, p1, p2, outer, &t)) return false;", ""}};
}

edits rounded_edges() {
  return {{"triangle.h", "return fma(p.x, q.y, -b) + fma(-p.y, q.x, b);", "return p.x * q.y - b;"}};
}

edits unchecked() {
  return {{"triangle.h", "largest >= 8.673617379884035e-19f &&", "true ||"},
          {"box.h", "if (!(fabs(c.x) < INFINITY))", "if (false)"},
          {"box.h", "if (!(fabs(c.y) < INFINITY))", "if (false)"},
          {"box.h", "if (!(fabs(c.z) < INFINITY))", "if (false)"}};
}

edits joined(std::initializer_list<edits> parts) {
  edits all;
  for (const edits& p : parts) all.insert(all.end(), p.begin(), p.end());
  return all;
}

edits moller_trumbore() {
  return {
      {"triangle.h", "typedef struct {\n  float3 o;", "typedef struct {\n  float3 o, direction;"},
      {"triangle.h", "  s->o = o;\n", "  s->o = o;\n  s->direction = d;\n"},
      {"triangle.h", "static inline bool hit_triangle(", "static inline bool unused("},
      {"triangle.h", "  return true;\n}\n\n#endif\n",
       std::string("  return true;\n}\n") + moller_trumbore_test}};
}

const tracer::kernel_edit contract{"vec.h", "#pragma OPENCL FP_CONTRACT OFF",
                                   "#pragma OPENCL FP_CONTRACT ON"};

}  // namespace

tracer::options with(const variant& v, tracer::options o) {
  o.edits.insert(o.edits.end(), v.edits.begin(), v.edits.end());
  o.compiler_flags += v.flags;
  return o;
}

std::vector<variant> inexact_variants() {
  std::vector<variant> all;
  const auto add = [&](const std::string& name, const std::string& about, edits e) {
    all.push_back({name, about, e, ""});
    e.push_back(contract);
    all.push_back({name + ", contracted", about + "; a*b+c may become an fma", e, ""});
    all.push_back(
        {name + ", fast-math", about + "; -cl-fast-relaxed-math", e, " -cl-fast-relaxed-math"});
  };
  const edits unguarded = joined({unpadded(), unordered(), unchecked()});
  add("moller-trumbore", "Moeller and Trumbore's test, nothing padded or ordered",
      joined({unguarded, moller_trumbore()}));
  add("plain edges", "edge functions rounded, nothing padded, held or ordered",
      joined({unguarded, unheld(), rounded_edges()}));
  return all;
}

std::vector<variant> single_guards() {
  return {{"less the pad", "slabs as they come out", unpadded()},
          {"less the order", "the first of equal hits wins", unordered()},
          {"less the hold", "t is never held to the triangle's own interval", unheld()},
          {"always held",
           "t is held also where that is sure to change nothing",
           {{"triangle.h", "if (!is_sure) {", "{"}}},
          {"less exact edges", "edge functions are rounded", rounded_edges()},
          {"less the checks", "no ray is refused", unchecked()}};
}

std::vector<variant> other_arithmetic() {
  return {{"contracted", "a*b+c may become an fma", {contract}, ""},
          {"fast-math", "-cl-fast-relaxed-math", {contract}, " -cl-fast-relaxed-math"}};
}

}  // namespace facet::study
