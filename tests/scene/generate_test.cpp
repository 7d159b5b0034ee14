#include "scene/generate.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <set>

#include "scene/mesh_checks.hpp"

using namespace facet;
using namespace facet::test;

namespace {

constexpr double pi = std::numbers::pi;

/// Closed kinds, with the parameters to try them with: fallbacks, the coarsest, and others.
const std::vector<std::pair<std::string, generator_parameters>> closed{
    {"box", {}},
    {"box", {{"size", 3}, {"x", 0.25}, {"z", 7}}},
    {"cylinder", {}},
    {"cylinder", {{"sides", 3}, {"smooth", 1}}},
    {"uv_sphere", {}},
    {"uv_sphere", {{"slices", 3}, {"stacks", 2}}},
    {"icosphere", {}},
    {"icosphere", {{"subdivisions", 0}, {"smooth", 0}}},
    {"icosphere", {{"subdivisions", 6}, {"radius", 1e6}}},
    {"noisy_sphere", {}},
    {"noisy_sphere", {{"subdivisions", 5}, {"amplitude", 0.9}, {"seed", 77}}},
    {"torus_knot", {}},
    {"torus_knot", {{"p", 3}, {"q", 7}, {"tube", 0.1}, {"sides", 3}, {"segments", 600}}},
    {"torus_knot", {{"p", 1}, {"q", 1}, {"smooth", 0}}},
    {"sphereflake", {{"depth", 2}, {"subdivisions", 1}}},
    {"sphereflake", {{"depth", 0}}},
    {"menger", {{"depth", 0}}},
    {"menger", {{"depth", 1}}},
    {"menger", {}},
};

std::uint32_t scrambled(std::uint32_t x) {
  x ^= x >> 16;
  x *= 2146121005u;
  x ^= x >> 15;
  x *= 2221713035u;
  x ^= x >> 16;
  return x;
}

}  // namespace

TEST_CASE("every kind makes a valid mesh without degenerate triangles from its fallbacks") {
  for (const generator_info& info : generators()) {
    CAPTURE(info.kind);
    const mesh m = generate(info.kind, {});
    CHECK(broken_promise(m) == "");
    CHECK(m.name == info.kind);
    CHECK(!info.about.empty());
    std::size_t flat = 0;
    for (std::size_t t = 0; t < m.triangle_count(); ++t) flat += length(face_normal(m, t)) == 0;
    CHECK(flat == 0);
  }
}

TEST_CASE("closed kinds use each edge once in each direction, share vertices and face outwards") {
  for (const auto& entry : closed) {
    CAPTURE(entry.first);
    const mesh m = generate(entry.first, entry.second);
    CAPTURE(m.triangle_count());
    CHECK(broken_promise(m) == "");
    CHECK(is_watertight(m));
    CHECK(volume(m) > 0);
    std::set<std::tuple<float, float, float>> distinct;
    for (vec3f p : m.positions) distinct.emplace(p.x, p.y, p.z);
    CHECK(distinct.size() == m.positions.size());
  }
}

TEST_CASE("solids have the volume of what they are named after") {
  // Inputs are rounded to float: relative error at most a few 2^-24 per coordinate.
  const double tolerance = 1e-6;
  CHECK(volume(generate("box", {{"size", 2}, {"x", 1}, {"y", 0.5}, {"z", 3}})) ==
        doctest::Approx(2 * 1 * 6).epsilon(tolerance));
  // A regular n-gon in a circle of radius r has the area n/2 r^2 sin(2 pi / n).
  CHECK(volume(generate("cylinder", {{"radius", 2}, {"height", 3}, {"sides", 5}})) ==
        doctest::Approx(3 * 2.5 * 4 * std::sin(2 * pi / 5)).epsilon(tolerance));
  // An icosahedron in a sphere of radius 1 has the edge a = 1 / sin(2 pi / 5), and the volume
  // 5/12 (3 + sqrt 5) a^3.
  const double a = 1 / std::sin(2 * pi / 5);
  const double icosahedron = 5.0 / 12 * (3 + std::sqrt(5.0)) * a * a * a;
  CHECK(volume(generate("icosphere", {{"subdivisions", 0}})) ==
        doctest::Approx(icosahedron).epsilon(tolerance));
  // Balls of the flake: 9^k of radius 3^-k, so that level k has a third of the volume of k - 1.
  CHECK(volume(generate("sphereflake", {{"depth", 3}, {"subdivisions", 0}})) ==
        doctest::Approx(icosahedron * (1 + 1 / 3.0 + 1 / 9.0 + 1 / 27.0)).epsilon(tolerance));
  CHECK(volume(generate("menger", {{"depth", 3}, {"size", 2}})) ==
        doctest::Approx(8 * std::pow(20.0 / 27, 3)).epsilon(tolerance));
  // Inscribed in the sphere: a facet of angular size s lies at most 1 - cos(s) deep.
  const double slice = 2 * pi / 256;
  const double ball = volume(generate("uv_sphere", {{"slices", 256}, {"stacks", 128}}));
  CHECK(ball < 4 * pi / 3);
  CHECK(ball > 4 * pi / 3 * std::pow(std::cos(slice), 3));
}

TEST_CASE("a torus knot is a tube of the given radius around its curve") {
  const int p = 2, q = 3, segments = 300, sides = 16;
  const double tube = 0.2;
  const mesh m = generate("torus_knot", {{"tube", tube}, {"segments", segments}, {"sides", sides}});
  double worst = 0;
  for (int i = 0; i < segments; ++i) {
    const double t = 2 * pi * i / segments, w = 1 + 0.5 * std::cos(q * t);
    const vec3d centre(w * std::cos(p * t), 0.5 * std::sin(q * t), -w * std::sin(p * t));
    for (int j = 0; j < sides; ++j) {
      const auto k = std::size_t(i * sides + j);
      const vec3d arm = vec3d(m.positions[k]) - centre;
      worst = std::max({worst, std::abs(length(arm) - tube),
                        length(normalize(arm) - vec3d(m.normals[k])) * tube});
    }
  }
  // Positions below 2 are rounded to float: at most 2^-24 in each of three axes.
  CHECK(worst < std::sqrt(3.0) * 0x1p-24 * 1.01);
}

TEST_CASE("smooth normals point out of the surface, and those of spheres along the radius") {
  for (const char* kind : {"cylinder", "uv_sphere", "icosphere", "torus_knot", "sphereflake"}) {
    CAPTURE(kind);
    const mesh m = generate(kind, {{"smooth", 1}});
    REQUIRE(m.is_smooth());
    double least = 1;
    for (std::size_t t = 0; t < m.triangle_count(); ++t)
      for (int k = 0; k < 3; ++k)
        least = std::min(least, dot(normalize(face_normal(m, t)), vec3d(m.normal(t, k))));
    CHECK(least > 0.8);  // the coarsest bend by fallback: 1/24 of a turn around the tube, and more
    CHECK(!generate(kind, {{"smooth", 0}}).is_smooth());
  }
  const mesh ball = generate("icosphere", {{"radius", 4}});
  double worst = 0;
  for (std::size_t i = 0; i < ball.positions.size(); ++i)
    worst = std::max(worst, length(vec3d(ball.positions[i]) - vec3d(ball.normals[i]) * 4.0));
  CHECK(worst == 0);  // times 4 is exact
}

TEST_CASE("a plane lies at y = 0, faces +y and has 2 n^2 triangles") {
  const mesh m = generate("plane", {{"size", 6}, {"divisions", 5}});
  CHECK(m.triangle_count() == 50);
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    CHECK(length(normalize(face_normal(m, t)) - vec3d(0, 1, 0)) == 0);
  CHECK(m.bounds() == box3f{{-3, 0, -3}, {3, 0, 3}});
}

TEST_CASE("a room's walls face inwards, in the order floor, ceiling, back, left, right") {
  const mesh m = generate("room", {{"size", 2}});
  REQUIRE(m.materials == std::vector<std::uint32_t>{0, 0, 1, 1, 2, 2, 3, 3, 4, 4});
  const vec3d facing[] = {{0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
  for (std::size_t t = 0; t < m.triangle_count(); ++t)
    CHECK(length(normalize(face_normal(m, t)) - facing[m.materials[t]]) == 0);
  CHECK(m.bounds() == box3f{{-1, 0, -1}, {1, 2, 1}});
  std::set<std::tuple<float, float, float>> corners;
  for (vec3f p : m.positions) corners.emplace(p.x, p.y, p.z);
  CHECK(corners.size() == 8);
}

TEST_CASE("a noisy sphere without noise is an icosphere, and with noise depends on the seed") {
  const mesh ball = generate("icosphere", {{"subdivisions", 2}});
  CHECK(generate("noisy_sphere", {{"subdivisions", 2}, {"amplitude", 0}}).positions ==
        ball.positions);
  const generator_parameters parameters{{"subdivisions", 2}, {"amplitude", 0.25}, {"seed", 3}};
  const mesh m = generate("noisy_sphere", parameters);
  CHECK(m.positions == generate("noisy_sphere", parameters).positions);
  CHECK(
      m.positions !=
      generate("noisy_sphere", {{"subdivisions", 2}, {"amplitude", 0.25}, {"seed", 4}}).positions);
  double least = 2, most = 0;
  for (vec3f p : m.positions) {
    least = std::min(least, length(vec3d(p)));
    most = std::max(most, length(vec3d(p)));
  }
  CHECK(least >= 0.75 - 1e-6);  // rounded to float
  CHECK(most <= 1.25 + 1e-6);
  CHECK(least < 0.8);  // 162 vertices: none in the lowest or highest tenth is a chance of 0.9^162
  CHECK(most > 1.2);
}

TEST_CASE("a terrain has exactly the positions of its formula in float, and faces up") {
  for (const int n : {1, 3, 16, 33, 100}) {
    const mesh m = generate("terrain", {{"n", n}});
    REQUIRE(m.positions.size() == std::size_t((n + 1) * (n + 1)));
    CHECK(m.triangle_count() == std::size_t(2 * n * n));
    int wrong = 0;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) {
        const float x = float(i) / float(n) - .5f, z = float(j) / float(n) - .5f;
        float y = .08f * sinf(9 * x) * cosf(7 * z);
        y = y + .02f * sinf(61 * x + 3 * z) * sinf(53 * z);
        y = y + .004f * sinf(311 * x) * sinf(293 * z + 11 * x);
        const std::uint32_t h = scrambled(7919u * unsigned(i / 16) + 104729u * unsigned(j / 16));
        if (h % 8 == 0) y += .03f * float((h >> 8) % 256) / 255.f;
        wrong += m.positions[std::size_t(j * (n + 1) + i)] != vec3f(x, y, z);
      }
    CHECK(wrong == 0);
    std::size_t down = 0;
    for (std::size_t t = 0; t < m.triangle_count(); ++t) down += face_normal(m, t).y <= 0;
    CHECK(down == 0);
  }
  const mesh m = generate("terrain", {{"n", 2}});
  CHECK(std::vector(m.indices.begin(), m.indices.begin() + 6) ==
        std::vector<std::uint32_t>{0, 3, 1, 1, 3, 4});
}

TEST_CASE("a soup has exactly the positions of its formula in float") {
  for (const int n : {1, 2, 1000}) {
    const mesh m = generate("soup", {{"n", n}});
    REQUIRE(m.triangle_count() == std::size_t(n));
    const float edge = .6f / cbrtf(float(n));
    std::uint32_t seed = 12345;
    float r[12];
    int wrong = 0;
    for (std::size_t t = 0; t < std::size_t(n); ++t) {
      for (float& value : r) {
        seed = scrambled(seed + 2654435769u);
        value = float(seed >> 8) * (1.f / 16777216.f) - .5f;
      }
      for (std::size_t k = 0; k < 3; ++k) {
        const float *d = r + 3 * (k + 1),
                    p[3] = {r[0] + d[0] * edge, r[1] + d[1] * edge, r[2] + d[2] * edge};
        wrong += m.indices[3 * t + k] != 3 * t + k;
        wrong += m.position(t, int(k)) != vec3f(p[0], p[1], p[2]);
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("the spheres of a flake are disjoint, and within two radii of the first centre") {
  const mesh m = generate("sphereflake", {{"depth", 3}, {"subdivisions", 0}});
  REQUIRE(m.positions.size() == 820 * 12);
  struct ball {
    vec3d centre;
    double radius;
  };
  std::vector<ball> balls;
  for (std::size_t i = 0; i < m.positions.size(); i += 12) {
    ball b{};
    for (std::size_t k = i; k < i + 12; ++k) b.centre = b.centre + vec3d(m.positions[k]) / 12.0;
    b.radius = length(vec3d(m.positions[i]) - b.centre);
    balls.push_back(b);
  }
  double gap = 1, reach = 0;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    reach = std::max(reach, length(balls[i].centre) + balls[i].radius);
    for (std::size_t j = 0; j < i; ++j)
      gap = std::min(gap,
                     length(balls[i].centre - balls[j].centre) - balls[i].radius - balls[j].radius);
  }
  // The smallest: 0.001 of (1/9 + 1/27). Positions below 2 are rounded by up to 2^-24 in each axis,
  // and a gap comes from two centres and two radii.
  CHECK(std::abs(gap - 0.001 * 4 / 27) < 4 * std::sqrt(3.0) * 0x1p-24);
  CHECK(reach < 2);
}

TEST_CASE("a Menger sponge shows only faces of cells without a neighbour") {
  for (const int depth : {0, 1, 2, 4}) {
    const mesh m = generate("menger", {{"depth", depth}});
    CHECK(double(m.triangle_count()) == 2 * (2 * std::pow(20.0, depth) + 4 * std::pow(8.0, depth)));
  }
}
