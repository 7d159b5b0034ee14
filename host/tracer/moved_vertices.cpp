#include "tracer/moved_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/validate.hpp"

namespace facet::tracer {
namespace {

bool is_allowed(vec3f p) {
  return std::abs(p.x) <= limits::coordinate && std::abs(p.y) <= limits::coordinate &&
         std::abs(p.z) <= limits::coordinate;
}

/// Within half of what validate_mesh allows, whatever rounding does here.
bool is_surely_unit(vec3f n) { return std::abs(dot(n, n) - 1) <= 1e-3f; }

/// Puts other vertices into a mesh, for as long as it lives.
class lent_vertices {
 public:
  lent_vertices(mesh& m, std::span<const vec3f> positions, std::span<const vec3f> normals)
      : mesh_(m),
        positions_(positions.begin(), positions.end()),
        normals_(normals.empty() ? m.normals : std::vector(normals.begin(), normals.end())) {
    swap();
  }
  ~lent_vertices() { swap(); }
  lent_vertices(const lent_vertices&) = delete;
  lent_vertices& operator=(const lent_vertices&) = delete;

 private:
  void swap() {
    std::swap(mesh_.positions, positions_);
    std::swap(mesh_.normals, normals_);
  }
  mesh& mesh_;
  std::vector<vec3f> positions_, normals_;
};

}  // namespace

bool uses_all_positions(const mesh& m) {
  std::vector<bool> is_used(m.positions.size(), false);
  for (const std::uint32_t i : m.indices) is_used[i] = true;
  return std::find(is_used.begin(), is_used.end(), false) == is_used.end();
}

box3f checked_bounds(scene& s, std::uint32_t mesh, std::span<const vec3f> positions,
                     std::span<const vec3f> normals, bool uses_all) {
  if (uses_all) {
    box3f bounds;
    bool is_sure = true;
    for (const vec3f& p : positions) bounds.add(p), is_sure &= is_allowed(p);
    for (const vec3f& n : normals) is_sure &= is_surely_unit(n);
    if (is_sure) return bounds;
  }
  const lent_vertices lent(s.meshes[mesh], positions, normals);
  validate_mesh(s, mesh, "");
  return s.meshes[mesh].bounds();
}

}  // namespace facet::tracer
