#include "study/cases/mistakes.hpp"

#include "study/kernel_edits.hpp"

namespace facet::study {
namespace {

mistake of(const char* name, const char* about, kernel_edits edits) {
  return {name, about, std::move(edits), ""};
}

}  // namespace

mistake moller_trumbore() {
  return of("moller-trumbore", "each triangle decides an edge by itself", moller_trumbore_test());
}

mistake determinant_epsilon() {
  return of("determinant-epsilon", "triangles with |det| < 1e-5 count as parallel",
            {{"triangle.h", "Mask is_hit = is_within(u, v, w);",
              "Mask is_hit = is_within(u, v, w) & (fabs(det) >= 1e-5f * (r->unit * r->unit));"}});
}

mistake world_plane() {
  return of(
      "world-plane", "t comes from a plane equation about the world's origin",
      joined({with_direction(),
              {{"triangle.h", "  const Real t = fma(top / det, r->t_of_unit, in_all(0.0f));",
                "  const Points p0 = swapped_corner(p, 0, r->order), p1 = swapped_corner(p, 1, "
                "r->order),\n"
                "               p2 = swapped_corner(p, 2, r->order);\n"
                "  const Real ax = p1.x - p0.x, ay = p1.y - p0.y, az = p1.z - p0.z;\n"
                "  const Real bx = p2.x - p0.x, by = p2.y - p0.y, bz = p2.z - p0.z;\n"
                "  const Real nx = ay * bz - az * by, ny = az * bx - ax * bz, nz = ax * by - ay * "
                "bx;\n"
                "  const Points o = r->origin, d = r->direction;\n"
                "  const Real t = (((nx * p0.x + ny * p0.y) + nz * p0.z) -\n"
                "            ((nx * o.x + ny * o.y) + nz * o.z)) /\n"
                "           ((nx * d.x + ny * d.y) + nz * d.z);"}}}));
}

mistake contraction() {
  return of("contraction", "edge functions are plain differences, and a*b+c may become an fma",
            joined({contracted(), rounded_edges()}));
}

mistake unpadded() { return of("unpadded", "slabs without a pad", unpadded_slabs()); }

mistake far_padding() {
  return of("far-padding", "slabs padded at the far side alone",
            {{"box.h", "is_known ? c - p :", "is_known ? c :"},
             {"space.h", "*near_offset = c - p;", "*near_offset = c;"}});
}

mistake unchecked_direction() {
  return of("unchecked-direction", "directions and origins of any size are used",
            {{"space.h", "p.z <= 1.152921504606847e18f))\n    return false;",
              "p.z <= 1.152921504606847e18f)) {}"}});
}

mistake no_tie_break() {
  return of(
      "no-tie-break", "of equal distances the first one met wins",
      {{"query.h", "!is_before(s, place, slot, q->place, q->slot)", "true"},
       {"packet_hits.h", " || is_before(s, place, slot, place_in_lane(p, lane), best) ?", " ?"}});
}

mistake truncated_nodes() {
  return of("truncated-nodes", "nodes keep of a coordinate its power of two alone",
            {{"box.h", "  return fma(face, (Each)(inverse), (Each)(offset));",
              "#ifdef FACET_WIDE\n"
              "  const Each cut = as_float8(as_uint8(face) & 0xff800000u);\n"
              "#else\n"
              "  const Each cut = as_float2(as_uint2(face) & 0xff800000u);\n"
              "#endif\n"
              "  return fma(cut, (Each)(inverse), (Each)(offset));"},
             {"box.h", "  const float4 sides = *(__global const float4*)axis;",
              "  const float4 sides = as_float4(*(__global const uint4*)axis & 0xff800000u);"}});
}

mistake chained_ties() {
  return of("chained-ties", "equal codes are joined one after the other (up to 28 of them)",
            {{"radix_tree.h", "32u + clz(i ^ (i + 1u))", "63u - i"}});
}

mistake kept_bad_vertices() {
  return of("kept-bad-vertices", "triangles with NaN or infinite corners are kept", {});
}

mistake short_leaves() {
  return of(
      "short-leaves", "a leaf's first triangle is left out",
      {{"search_narrow.h", "for (uint k = 0; k < count; ++k)", "for (uint k = 1; k < count; ++k)"},
       {"lanes.h", "return lanes_of(m);", "return lanes_of(m) & 0xfeu;"}});
}

mistake open_points() {
  return of("open-points", "a determinant of 0 is a hit at the corner's distance",
            {{"triangle.h", "have_side & (near <= far)", "near <= far"},
             {"triangle.h", " & (hits->det != 0.0f);", ";"},
             {"triangle.h", "fma(top / det,", "fma(det == 0.0f ? a.z : top / det,"}});
}

mistake constant_offset() {
  return of("constant-offset", "secondary rays start 1e-4 away from the surface",
            {{"surface.h", "f.delta = dot3(", "f.delta = 1e-4f + 0.0f * dot3("}});
}

mistake wrong_normals() {
  return of("wrong-normals", "normals travel like directions, not by the inverse transpose",
            {{"surface.h", "return map_normal(s->instances[place].object_from_world, n);",
              "return map_vector(s->instances[place].world_from_object, n);"}});
}

mistake unchecked_refraction() {
  return of(
      "unchecked-refraction", "beyond the critical angle the root is taken all the same",
      {{"states.h", "if (k < 0.0f) return false;", ""},
       {"states.h", " &&\n                  dot3(behind.direction, f->geometric) < 0.0f;", ";"}});
}

mistake reversed_media() {
  return of(
      "reversed-media", "entering a medium counts as leaving it",
      {{"query.h", "is_front ? t_end - t : -(t_end - t)", "is_front ? -(t_end - t) : t_end - t"}});
}

mistake unchecked_normals() {
  return of(
      "unchecked-normals", "normals of length 0 are divided by their length",
      {{"surface.h", "return is_finite && largest > 0.0f ? normalize3(n / largest) : instead;",
        "return normalize3(n);"}});
}

mistake wrapped_offsets() {
  return of("wrapped-offsets",
            "byte offsets of corners wrap: at 2^19, where small meshes show it, in place of 2^31",
            {{"geometry.h", "return g[index].xyz;", "return g[index & 0x7fffu].xyz;"},
             {"geometry.h", "(__global const TriangleBlock*)g + block",
              "(__global const TriangleBlock*)g + block % 0x71cu"}});
}

mistake exclusive_edges() {
  return of("exclusive-edges", "a ray through an edge meets neither of its triangles",
            {{"triangle.h", "(least >= 0.0f) | (most <= 0.0f)", "(least > 0.0f) | (most < 0.0f)"}});
}

mistake short_stack() {
  return of(
      "short-stack", "what does not fit on a stack of 4 is left out",
      {{"search_narrow.h", "if (is_first && is_second)",
        "if (is_first && is_second && w->top < 4)"},
       {"search_wide.h", "stack[(*top)++] = max(a, b);",
        "if (*top < 4) stack[(*top)++] = max(a, b);"},
       {"search_wide.h", "int k = (*top)++;", "if (*top >= 4) continue;\n    int k = (*top)++;"},
       {"search_wide.h", "stack[(*top)++] = next;", "if (*top < 4) stack[(*top)++] = next;"},
       {"search_stream.h", "l->top += popcount(lanes);",
        "l->top = min(l->top + (int)popcount(lanes), 4);"}});
}

mistake inclusive_edges() {
  return of("inclusive-edges", "an edge is crossed in both of its triangles",
            {{"query.h", "if (is_counted) add_crossing(", "add_crossing("}});
}

}  // namespace facet::study
