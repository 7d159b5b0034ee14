// What tests of meshes share: the promises that every mesh keeps.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh.hpp"
#include "scene/scene.hpp"

namespace facet::test {

/// The first promise of mesh.hpp that `m` breaks, or nothing.
inline std::string broken_promise(const mesh& m) {
  const std::size_t n = m.triangle_count();
  const auto all_below = [](const std::vector<std::uint32_t>& indices, std::size_t end) {
    return std::all_of(indices.begin(), indices.end(), [&](auto i) { return i < end; });
  };
  if (n == 0 || m.indices.size() != 3 * n) return "not a whole number of triangles above 0";
  if (!all_below(m.indices, m.positions.size())) return "an index out of range";
  if (!all_below(m.normal_indices, m.normals.size())) return "a normal's index out of range";
  if (!m.normal_indices.empty() && m.normal_indices.size() != 3 * n) return "too few normals";
  if (!m.materials.empty() && m.materials.size() != n) return "too few materials";
  if (m.source.empty() != (m.dropped == 0)) return "sources without drops, or drops without";
  if (!m.source.empty() && m.source.size() != n) return "too few sources";
  for (vec3f p : m.positions)
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(p[axis]) <= limits::coordinate)) return "a position that is not usable";
  // A unit vector in double, each component rounded to float: |error| <= 2^-25 of each, so at most
  // that of the length; doubled for the rounding of the sum here.
  for (vec3f v : m.normals)
    if (!(std::abs(length(vec3d(v)) - 1) <= 0x1p-24)) return "a normal that is not unit";
  return {};
}

/// Whether each edge is used exactly once in each direction: closed, and wound one way throughout.
inline bool is_watertight(const mesh& m) {
  std::vector<std::uint64_t> edges;
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      edges.push_back(std::uint64_t(m.indices[3 * t + k]) << 32 | m.indices[3 * t + (k + 1) % 3]);
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&](std::uint64_t e) {
    return std::binary_search(edges.begin(), edges.end(), e << 32 | e >> 32);
  });
}

/// Positive for a closed mesh that faces outwards.
inline double volume(const mesh& m) {
  double sum = 0;
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    sum += dot(vec3d(m.position(t, 0)), cross(vec3d(m.position(t, 1)), vec3d(m.position(t, 2))));
  return sum / 6;
}

/// Of length twice the area.
inline vec3d face_normal(const mesh& m, std::size_t t) {
  const vec3d a(m.position(t, 0)), b(m.position(t, 1)), c(m.position(t, 2));
  return cross(b - a, c - a);
}

inline bool any_holds(const std::vector<std::string>& texts, std::string_view part) {
  return std::any_of(texts.begin(), texts.end(),
                     [&](const auto& t) { return t.find(part) != t.npos; });
}

}  // namespace facet::test
