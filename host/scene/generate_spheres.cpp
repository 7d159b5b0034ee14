// UV sphere, icosphere and noisy sphere.
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "scene/generator.hpp"

namespace facet {
namespace {

double icosphere_triangles(const arguments& a) { return 20 * std::pow(4.0, a["subdivisions"]); }

/// Vertices: the north pole, stacks - 1 rings of `slices`, the south pole.
mesh make_uv_sphere(const arguments& a) {
  const std::uint32_t slices = a.whole("slices"), stacks = a.whole("stacks");
  std::vector<vec3d> directions{{0, 1, 0}};
  for (std::uint32_t j = 1; j < stacks; ++j)
    for (std::uint32_t i = 0; i < slices; ++i) {
      const double down = std::numbers::pi * j / stacks, around = 2 * std::numbers::pi * i / slices;
      directions.push_back(
          {std::sin(down) * std::cos(around), std::cos(down), -std::sin(down) * std::sin(around)});
    }
  directions.push_back({0, -1, 0});

  mesh m;
  for (vec3d d : directions) m.positions.push_back(vec3f(d * a["radius"]));
  const auto ring = [&](std::uint32_t j, std::uint32_t i) { return 1 + (j - 1) * slices + i; };
  const auto south = std::uint32_t(directions.size() - 1);
  for (std::uint32_t i = 0; i < slices; ++i) {
    const std::uint32_t n = (i + 1) % slices;
    add_triangle(m, 0, ring(1, i), ring(1, n));
    for (std::uint32_t j = 1; j + 1 < stacks; ++j)
      add_quad(m, ring(j, i), ring(j + 1, i), ring(j + 1, n), ring(j, n));
    add_triangle(m, south, ring(stacks - 1, n), ring(stacks - 1, i));
  }
  if (a.on("smooth")) {
    for (vec3d d : directions) m.normals.push_back(vec3f(normalize(d)));
    m.normal_indices = m.indices;
  }
  return m;
}

mesh make_icosphere(const arguments& a) {
  unit_sphere sphere = make_unit_icosphere(a.whole("subdivisions"));
  mesh m;
  m.indices = std::move(sphere.indices);
  for (vec3d d : sphere.directions) m.positions.push_back(vec3f(d * a["radius"]));
  if (a.on("smooth")) {
    for (vec3d d : sphere.directions) m.normals.push_back(vec3f(d));
    m.normal_indices = m.indices;
  }
  return m;
}

/// The finaliser of MurmurHash3 (Austin Appleby, public domain), 64 bits.
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 33)) * 0xff51afd7ed558ccdu;
  x = (x ^ (x >> 33)) * 0xc4ceb9fe1a85ec53u;
  return x ^ (x >> 33);
}

/// Each vertex moves along its own radius, so that the surface stays closed and never meets itself.
mesh make_noisy_sphere(const arguments& a) {
  unit_sphere sphere = make_unit_icosphere(a.whole("subdivisions"));
  const std::uint64_t seed = mix(std::uint64_t(a["seed"]) + 1);
  mesh m;
  m.indices = std::move(sphere.indices);
  for (std::size_t i = 0; i < sphere.directions.size(); ++i) {
    const double noise = double(mix(seed + i) >> 11) * 0x1p-52 - 1;  // in [-1, 1)
    m.positions.push_back(
        vec3f(sphere.directions[i] * (a["radius"] * (1 + a["amplitude"] * noise))));
  }
  return m;
}

}  // namespace

unit_sphere make_unit_icosphere(std::uint32_t subdivisions) {
  // The 12 vertices are the corners of three golden rectangles, (±1, ±g, 0) and its rotations.
  const double g = std::numbers::phi;
  unit_sphere s;
  for (vec3d v : {vec3d(-1, g, 0), vec3d(1, g, 0), vec3d(-1, -g, 0), vec3d(1, -g, 0),
                  vec3d(0, -1, g), vec3d(0, 1, g), vec3d(0, -1, -g), vec3d(0, 1, -g),
                  vec3d(g, 0, -1), vec3d(g, 0, 1), vec3d(-g, 0, -1), vec3d(-g, 0, 1)})
    s.directions.push_back(normalize(v));
  s.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
               4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
               6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};

  for (std::uint32_t level = 0; level < subdivisions; ++level) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    middles.reserve(s.indices.size() / 2);
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
      const std::uint64_t edge = std::uint64_t(std::min(a, b)) << 32 | std::max(a, b);
      const auto [found, fresh] = middles.try_emplace(edge, std::uint32_t(s.directions.size()));
      if (fresh) s.directions.push_back(normalize(s.directions[a] + s.directions[b]));
      return found->second;
    };
    std::vector<std::uint32_t> finer;
    finer.reserve(s.indices.size() * 4);
    for (std::size_t t = 0; t < s.indices.size(); t += 3) {
      const std::uint32_t a = s.indices[t], b = s.indices[t + 1], c = s.indices[t + 2];
      const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca});
    }
    s.indices = std::move(finer);
  }
  return s;
}

std::vector<generator> sphere_generators() {
  const auto radius = length_parameter("radius", 1, "of the sphere through its vertices");
  const auto subdivisions =
      whole_parameter("subdivisions", 3, 0, 8, "20 * 4^subdivisions triangles");
  return {
      {{"uv_sphere",
        {radius, whole_parameter("slices", 64, 3, 1 << 16, "around the y axis"),
         whole_parameter("stacks", 32, 2, 1 << 16, "from pole to pole"), smooth_parameter(true)},
        "a closed sphere around the origin in slices and stacks"},
       [](const arguments& a) { return 2 * a["slices"] * (a["stacks"] - 1); },
       make_uv_sphere},
      {{"icosphere",
        {radius, subdivisions, smooth_parameter(true)},
        "a closed sphere around the origin of nearly equal triangles; 0 subdivisions make an "
        "icosahedron"},
       icosphere_triangles,
       make_icosphere},
      {{"noisy_sphere",
        {length_parameter("radius", 1, "of the sphere before the noise"),
         subdivisions,
         {"amplitude", 0.1, 0, 0.9, false, "largest part of the radius that a vertex moves by"},
         whole_parameter("seed", 1, 0, 1e9, "another seed, another noise")},
        "a closed, jagged sphere around the origin: an icosphere with each vertex moved along its "
        "radius by noise"},
       icosphere_triangles,
       make_noisy_sphere},
  };
}

}  // namespace facet
