// One generator of meshes, as generate.cpp lists them: what it takes, how much it makes, how.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "scene/generate.hpp"
#include "scene/mesh.hpp"

namespace facet {

/// Parameters of one call: complete, and within their limits.
class arguments {
 public:
  explicit arguments(std::map<std::string, double> values) : values_(std::move(values)) {}
  double operator[](const char* name) const { return values_.at(name); }
  std::uint32_t whole(const char* name) const { return std::uint32_t(values_.at(name)); }
  bool on(const char* name) const { return values_.at(name) != 0; }

 private:
  std::map<std::string, double> values_;
};

struct generator {
  generator_info info;
  double (*triangles)(const arguments&);  ///< how many `make` will make; never overflows
  mesh (*make)(const arguments&);
};

std::vector<generator> plain_generators();      ///< plane, box, cylinder, room
std::vector<generator> sphere_generators();     ///< uv_sphere, icosphere, noisy_sphere
std::vector<generator> surface_generators();    ///< torus_knot, terrain, soup
std::vector<generator> recursive_generators();  ///< sphereflake, menger

/// Lengths that a generator takes: far from limits::coordinate and from underflow.
inline constexpr double least_length = 1e-9, most_length = 1e9;

inline generator_info::parameter length_parameter(const char* name, double fallback,
                                                  const char* about) {
  return {name, fallback, least_length, most_length, false, about};
}
inline generator_info::parameter whole_parameter(const char* name, double fallback, double least,
                                                 double most, const char* about) {
  return {name, fallback, least, most, true, about};
}
inline generator_info::parameter smooth_parameter(bool fallback) {
  return whole_parameter("smooth", fallback ? 1 : 0, 0, 1, "1: with normals; 0: flat faces");
}

inline void add_triangle(mesh& m, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  m.indices.insert(m.indices.end(), {a, b, c});
}
/// a, b, c, d go around counter-clockwise.
inline void add_quad(mesh& m, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  m.indices.insert(m.indices.end(), {a, b, c, a, c, d});
}

/// A sphere of radius 1 around the origin: an icosahedron whose faces were split in 4 and pushed
/// out `subdivisions` times. 20 * 4^subdivisions triangles.
struct unit_sphere {
  std::vector<vec3d> directions;
  std::vector<std::uint32_t> indices;
};
unit_sphere make_unit_icosphere(std::uint32_t subdivisions);

}  // namespace facet
