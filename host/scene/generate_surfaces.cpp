// Torus knot, terrain and soup.
#include <cmath>
#include <numbers>
#include <numeric>

#include "scene/error.hpp"
#include "scene/generator.hpp"

namespace facet {
namespace {

/// The curve on a torus of radii `radius` and radius/2, around the y axis p times and through the
/// hole q times, with a tube of circles around it. The circles' frame comes from the position,
/// which is never along the tangent; so it closes after one round without a twist to undo.
mesh make_torus_knot(const arguments& a) {
  const double p = a["p"], q = a["q"], r = a["radius"] / 2;
  if (std::gcd(a.whole("p"), a.whole("q")) != 1)
    throw scene_error("", "q",
                      "p and q have a common divisor, so that the curve would run over itself; "
                      "allowed are numbers without one, such as 2 and 3");
  const std::uint32_t segments = a.whole("segments"), sides = a.whole("sides");
  mesh m;
  for (std::uint32_t i = 0; i < segments; ++i) {
    const double t = 2 * std::numbers::pi * i / segments;
    const double cp = std::cos(p * t), sp = std::sin(p * t), cq = std::cos(q * t),
                 sq = std::sin(q * t);
    const vec3d centre = vec3d((2 + cq) * cp, sq, -(2 + cq) * sp) * r;
    const vec3d tangent =
        normalize(vec3d(-q * sq * cp - p * (2 + cq) * sp, q * cq, q * sq * sp - p * (2 + cq) * cp));
    const vec3d binormal = normalize(cross(tangent, centre));
    const vec3d normal = cross(binormal, tangent);
    for (std::uint32_t j = 0; j < sides; ++j) {
      const double s = 2 * std::numbers::pi * j / sides;
      const vec3d out = normal * std::cos(s) + binormal * std::sin(s);
      m.positions.push_back(vec3f(centre + out * a["tube"]));
      if (a.on("smooth")) m.normals.push_back(vec3f(normalize(out)));
    }
  }
  for (std::uint32_t i = 0; i < segments; ++i)
    for (std::uint32_t j = 0; j < sides; ++j) {
      const std::uint32_t here = i * sides, next = (i + 1) % segments * sides, k = (j + 1) % sides;
      add_quad(m, here + j, here + k, next + k, next + j);
    }
  if (a.on("smooth")) m.normal_indices = m.indices;
  return m;
}

/// The lowbias32 hash (Chris Wellons).
std::uint32_t hash(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

/// Height at (x, z): three waves, and towers on one in eight of the blocks of 16 by 16 vertices.
/// Float throughout, in this order: measurements are compared on exactly this surface.
float terrain_height(float x, float z, std::uint32_t block_x, std::uint32_t block_z) {
  float y = .08f * std::sin(9 * x) * std::cos(7 * z) +
            .02f * std::sin(61 * x + 3 * z) * std::sin(53 * z) +
            .004f * std::sin(311 * x) * std::sin(293 * z + 11 * x);
  const std::uint32_t block = hash(block_x * 7919u + block_z * 104729u);
  if ((block & 7) == 0) y += .03f * float((block >> 8) & 255) / 255.f;
  return y;
}

mesh make_terrain(const arguments& a) {
  const std::uint32_t n = a.whole("n");
  mesh m;
  m.positions.reserve(std::size_t(n + 1) * (n + 1));
  m.indices.reserve(std::size_t(n) * n * 6);
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      const float x = float(i) / float(n) - .5f, z = float(j) / float(n) - .5f;
      m.positions.emplace_back(x, terrain_height(x, z, i / 16, j / 16), z);
    }
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t near = j * (n + 1) + i, far = near + n + 1;
      add_triangle(m, near, far, near + 1);
      add_triangle(m, near + 1, far, far + 1);
    }
  return m;
}

/// n triangles of about 1/cbrt(n) in a unit cube, in float and from one sequence of random numbers:
/// measurements are compared on exactly this soup.
mesh make_soup(const arguments& a) {
  const std::uint32_t n = a.whole("n");
  const float edge = .6f / std::cbrt(float(n));
  std::uint32_t state = 12345;
  const auto centred = [&state] {
    state = hash(state + 0x9e3779b9u);
    return float(state >> 8) * 0x1p-24f - .5f;
  };
  const auto centred3 = [&centred] {
    const float x = centred(), y = centred(), z = centred();
    return vec3f(x, y, z);
  };
  mesh m;
  m.positions.reserve(std::size_t(n) * 3);
  for (std::uint32_t i = 0; i < n; ++i) {
    const vec3f centre = centred3();
    for (int corner = 0; corner < 3; ++corner) m.positions.push_back(centre + centred3() * edge);
  }
  m.indices.resize(m.positions.size());
  std::iota(m.indices.begin(), m.indices.end(), 0u);
  return m;
}

}  // namespace

std::vector<generator> surface_generators() {
  return {
      {{"torus_knot",
        {whole_parameter("p", 2, 1, 64, "turns around the y axis"),
         whole_parameter("q", 3, 1, 64, "turns through the hole; no common divisor with p"),
         length_parameter("radius", 1, "of the torus that the curve lies on; it reaches 1.5 radii"),
         length_parameter("tube", 0.25, "radius of the tube"),
         whole_parameter("segments", 256, 3, 1 << 20, "along the curve"),
         whole_parameter("sides", 24, 3, 1 << 16, "around the tube"), smooth_parameter(true)},
        "a closed tube along a torus knot around the y axis; thick tubes meet themselves"},
       [](const arguments& a) { return 2 * a["segments"] * a["sides"]; },
       make_torus_knot},
      {{"terrain",
        {whole_parameter("n", 100, 1, 8000, "squares along a side; 2 n^2 triangles")},
        "hills with towers over the unit square around the origin"},
       [](const arguments& a) { return 2 * a["n"] * a["n"]; },
       make_terrain},
      {{"soup",
        {whole_parameter("n", 1000, 1, 1 << 27, "triangles")},
        "random small triangles in the unit cube around the origin"},
       [](const arguments& a) { return a["n"]; },
       make_soup},
  };
}

}  // namespace facet
