#include "scene/mesh_file.hpp"

#include <algorithm>
#include <cmath>

#include "scene/error.hpp"
#include "scene/scene.hpp"

namespace facet {
namespace {

/// The unit normal of triangle `t`; any unit vector if its area is 0, where no ray will ask.
vec3f geometric_normal(const mesh& m, std::size_t t) {
  const vec3d a(m.position(t, 0)), b(m.position(t, 1)), c(m.position(t, 2));
  const vec3d n = cross(b - a, c - a);
  const double size = length(n);
  return size > 0 ? vec3f(n / size) : vec3f(0, 1, 0);
}

std::string count_of(std::size_t n, const std::string& thing) {
  return std::to_string(n) + ' ' + thing + (n == 1 ? "" : "s");
}

}  // namespace

mesh_builder::mesh_builder(std::filesystem::path path) : path_(std::move(path)) {}

bool mesh_builder::is_usable(vec3f position) {
  const vec3f size = abs(position);
  return size.x <= limits::coordinate && size.y <= limits::coordinate &&
         size.z <= limits::coordinate;  // false for NaN
}

std::string mesh_builder::too_many() {
  return "there are more than " + std::to_string(limits::triangles) +
         " triangles, which is all that a scene may have";
}

bool mesh_builder::add_face(std::span<const corner> corners, std::uint32_t material) {
  if (corners.size() > 2 && corners.size() - 2 > limits::triangles - materials_.size())
    return false;
  ++faces_;
  if (corners.size() < 3) {
    ++thin_faces_;
    return true;
  }
  const bool smooth =
      std::all_of(corners.begin(), corners.end(), [](corner c) { return c.normal != none; });
  // The list of normals begins with the first face that has some.
  if (smooth) normal_indices_.resize(indices_.size(), none);
  const bool listed = smooth || !normal_indices_.empty();
  for (std::size_t i = 2; i < corners.size(); ++i) {
    for (const corner& c : {corners[0], corners[i - 1], corners[i]}) {
      indices_.push_back(c.position);
      if (listed) normal_indices_.push_back(smooth ? c.normal : none);
    }
    materials_.push_back(material);
  }
  return true;
}

mesh_file mesh_builder::finish(const std::string& first_unusable) {
  mesh_file result;
  result.mesh.name = path_.stem().string();
  if (materials_.empty())
    throw scene_error(path_.string(), "",
                      "there is no triangle in it: found " + count_of(faces_, "face") +
                          (faces_ ? ", none with 3 corners or more" : ""));
  if (thin_faces_)
    result.notes.push_back(path_.filename().string() + ": " + count_of(thin_faces_, "face") +
                           " with fewer than 3 corners ignored");
  drop_unusable(result, first_unusable);
  settle_normals(result);
  return result;
}

void mesh_builder::drop_unusable(mesh_file& result, const std::string& first_unusable) {
  mesh& m = result.mesh;
  m.positions = std::move(positions);
  std::vector<bool> unusable(m.positions.size());
  for (std::size_t i = 0; i < m.positions.size(); ++i)
    if (!is_usable(m.positions[i])) unusable[i] = true, m.positions[i] = vec3f();

  const std::size_t before = materials_.size();
  std::size_t kept = 0;
  for (std::size_t t = 0; t < before; ++t) {
    const bool drop =
        unusable[indices_[3 * t]] || unusable[indices_[3 * t + 1]] || unusable[indices_[3 * t + 2]];
    if (drop && m.dropped++ == 0) {
      m.source.resize(t);
      for (std::size_t i = 0; i < t; ++i) m.source[i] = std::uint32_t(i);
    }
    if (drop) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      indices_[3 * kept + i] = indices_[3 * t + i];
      if (!normal_indices_.empty()) normal_indices_[3 * kept + i] = normal_indices_[3 * t + i];
    }
    materials_[kept++] = materials_[t];
    if (m.dropped) m.source.push_back(std::uint32_t(t));
  }
  const std::string why = "a coordinate that is not a finite number of at most 1e18 in size" +
                          (first_unusable.empty() ? "" : " (the first: " + first_unusable + ")");
  if (kept == 0)
    throw scene_error(
        path_.string(), "",
        "there is no usable triangle in it: each of " + std::to_string(before) + " has " + why);
  if (m.dropped)
    result.notes.push_back(path_.filename().string() + ": " + count_of(m.dropped, "triangle") +
                           " dropped for " + why);
  indices_.resize(3 * kept);
  materials_.resize(kept);
  if (!normal_indices_.empty()) normal_indices_.resize(3 * kept);
  m.indices = std::move(indices_);
  if (std::any_of(materials_.begin(), materials_.end(), [](auto i) { return i != 0; }))
    m.materials = std::move(materials_);
}

void mesh_builder::settle_normals(mesh_file& result) {
  mesh& m = result.mesh;
  if (std::all_of(normal_indices_.begin(), normal_indices_.end(),
                  [](std::uint32_t i) { return i == none; }))
    return;
  m.normals = std::move(normals);
  std::vector<bool> unusable(m.normals.size());
  for (std::size_t i = 0; i < m.normals.size(); ++i) {
    const vec3d n(m.normals[i]);
    const double size = length(n);
    unusable[i] = !(size > 0 && std::isfinite(size));
    m.normals[i] = unusable[i] ? vec3f(0, 1, 0) : vec3f(n / size);
  }

  std::size_t replaced = 0, without = 0;
  m.normal_indices = std::move(normal_indices_);
  for (std::size_t t = 0; t < m.triangle_count(); ++t) {
    std::uint32_t own = none;
    bool bad = false;
    for (std::size_t i = 3 * t; i < 3 * t + 3; ++i) {
      std::uint32_t& index = m.normal_indices[i];
      if (index != none && !unusable[index]) continue;
      bad = bad || index != none;
      if (own == none) {
        own = std::uint32_t(m.normals.size());
        m.normals.push_back(geometric_normal(m, t));
      }
      index = own;
    }
    replaced += bad;
    without += own != none && !bad;
  }
  const std::string file = path_.filename().string() + ": ";
  if (replaced)
    result.notes.push_back(file + count_of(replaced, "triangle") +
                           " with a normal of length 0 or not finite: there, the triangle's own "
                           "normal is used");
  if (without)
    result.notes.push_back(file + count_of(without, "triangle") +
                           " without normals among others with: they are flat");
}

}  // namespace facet
