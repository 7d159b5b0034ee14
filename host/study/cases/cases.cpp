#include "study/cases/cases.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "study/cases/families.hpp"
#include "study/cases/mistakes.hpp"

namespace facet::study {
namespace {

constexpr std::array<hard_case, 26> table{{
    {1, "closed mesh, random rays", true, closed_random, determinant_epsilon},
    {2, "closed mesh, rays at vertices", true, closed_vertices, moller_trumbore},
    {3, "closed mesh, rays along edges", true, closed_edges, moller_trumbore},
    {4, "closed meshes, moved and scaled", true, closed_moved, contraction},
    {5, "slivers", false, slivers, moller_trumbore},
    {6, "grazing rays", false, grazing, world_plane},
    {7, "zeros in the direction", true, zero_directions, unpadded},
    {8, "flat boxes", false, flat_boxes, unpadded},
    {9, "tiny and huge directions", false, extreme_directions, unchecked_direction},
    {10, "coplanar duplicates", false, duplicates, no_tie_break},
    {11, "one scene, every way to trace it", true, every_way, far_padding},
    {12, "extreme nodes", false, extreme_nodes, truncated_nodes},
    {13, "equal Morton codes", false, equal_codes, chained_ties},
    {14, "geometric series", false, geometric_series, short_stack},
    {15, "bad vertices", false, bad_vertices, kept_bad_vertices},
    {16, "few triangles", false, few_triangles, short_leaves},
    {17, "zero-area triangles", false, zero_areas, open_points},
    {18, "leaving a surface", true, leaving, constant_offset},
    {19, "parallel sheets", false, sheets, constant_offset},
    {20, "instances", false, placed, wrong_normals},
    {21, "a seam between instances", false, seams, exclusive_edges},
    {22, "the critical angle", false, critical_angle, unchecked_refraction},
    {23, "glass within glass, eye and light inside", false, inside_glass, reversed_media},
    {24, "bad shading normals", false, bad_normals, unchecked_normals},
    {25, "many triangles, many instances", false, many, wrapped_offsets},
    {26, "crossings of closed glass", true, glass_crossings, inclusive_edges},
}};

}  // namespace

std::span<const hard_case> hard_cases() { return table; }

bool case_report::is_met() const {
  return std::all_of(findings.begin(), findings.end(), [](const finding& f) { return f.is_met(); });
}

std::uint64_t case_report::failures() const {
  std::uint64_t sum = 0;
  for (const finding& f : findings)
    if (f.is_goal) sum += f.failures();
  return sum;
}

case_report run_case(const hard_case& c, lab l, bool with_mistake) {
  const auto start = std::chrono::steady_clock::now();
  mistake m;
  if (with_mistake) {
    m = c.wrong();
    l.wrong = &m;
  }
  l.findings.clear();
  c.run(l);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return {c.number, c.name, m.name, std::move(l.findings), took.count()};
}

}  // namespace facet::study
