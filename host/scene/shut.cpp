#include "scene/shut.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <tuple>
#include <utility>

namespace facet {
namespace {

/// An edge by where its ends are: files may list a corner more than once.
struct edge {
  vec3f low, high;

  edge(vec3f a, vec3f b) : low(a), high(b) {
    if (key(b) < key(a)) std::swap(low, high);
  }
  static std::tuple<float, float, float> key(vec3f p) { return {p.x, p.y, p.z}; }
  friend bool operator<(const edge& a, const edge& b) {
    return std::pair(key(a.low), key(a.high)) < std::pair(key(b.low), key(b.high));
  }
};

std::array<edge, 3> edges_of(const mesh& m, std::size_t t) {
  const vec3f a = m.position(t, 0), b = m.position(t, 1), c = m.position(t, 2);
  return {edge(a, b), edge(b, c), edge(c, a)};
}

/// The triangles on one edge.
struct shared_by {
  bool has_area = false;               ///< one of them has
  std::size_t count = 0;               ///< of those that are open
  std::vector<std::uint32_t> lines{};  ///< those without an area
};

}  // namespace

bool has_area(vec3f a, vec3f b, vec3f c) {
  const vec3d p(a), q(b), r(c);
  return cross(q - p, r - p) != vec3d();
}

std::vector<bool> shut_triangles(const mesh& m) {
  const std::size_t n = m.triangle_count();
  std::vector<bool> is_shut(n, false);
  std::vector<std::uint32_t> lines;
  for (std::uint32_t t = 0; t < n; ++t) {
    const vec3f a = m.position(t, 0), b = m.position(t, 1), c = m.position(t, 2);
    if (has_area(a, b, c)) continue;
    is_shut[t] = true;
    if (a != b && b != c && c != a) lines.push_back(t);
  }
  if (lines.empty()) return is_shut;

  std::map<edge, shared_by> shared;
  for (const std::uint32_t t : lines)
    for (const edge& e : edges_of(m, t)) {
      shared[e].lines.push_back(t);
      ++shared[e].count;
    }
  for (std::uint32_t t = 0; t < n; ++t) {
    if (is_shut[t]) continue;
    for (const edge& e : edges_of(m, t))
      if (const auto at = shared.find(e); at != shared.end()) {
        at->second.has_area = true;
        ++at->second.count;
      }
  }

  // Lines with an edge of their own fall away, and then those that only they held.
  std::vector<bool> has_fallen(n, false);
  std::vector<std::uint32_t> waiting = lines;
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    const auto edges = edges_of(m, t);
    bool is_held = true;
    for (const edge& e : edges) is_held = is_held && shared[e].count > 1;
    if (has_fallen[t] || is_held) continue;
    has_fallen[t] = true;
    for (const edge& e : edges) {
      --shared[e].count;
      for (const std::uint32_t other : shared[e].lines) waiting.push_back(other);
    }
  }

  // From those beside a triangle with an area on to all that hang together with them.
  for (const std::uint32_t t : lines)
    for (const edge& e : edges_of(m, t))
      if (shared[e].has_area) waiting.push_back(t);
  while (!waiting.empty()) {
    const std::uint32_t t = waiting.back();
    waiting.pop_back();
    if (has_fallen[t] || !is_shut[t]) continue;
    is_shut[t] = false;
    for (const edge& e : edges_of(m, t))
      for (const std::uint32_t other : shared[e].lines) waiting.push_back(other);
  }
  return is_shut;
}

}  // namespace facet
