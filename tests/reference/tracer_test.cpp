// Pictures of the serial tracer: samples, alpha, progress, and the signature of a pixel.
#include "reference/tracer.hpp"

#include <doctest/doctest.h>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

/// A glass ball and a mirror ball over a floor.
scene still_life() {
  scene s;
  s.view.position = {0, 1, 5};
  s.background = {0.25f, 0.5f, 1};
  s.background_alpha = 0.5f;
  material glass = test::clear(1.5f);
  glass.Kr = {0.1f, 0.1f, 0.1f};
  material mirror = test::black();
  mirror.Kr = {0.75f, 0.75f, 0.75f};
  const mesh ball = generate("icosphere", {{"subdivisions", 3}, {"smooth", 1}});
  test::add(s, ball, glass, transform::translate({-1.2, 0.1, 0}));
  test::add(s, ball, mirror, transform::translate({1.2, 0.1, 0}));
  test::add(s, generate("plane", {{"size", 8}}), material{}, transform::translate({0, -1, 0}));
  light l;
  l.position = {2, 4, 3};
  s.lights.push_back(l);
  return s;
}

}  // namespace

TEST_CASE("a pixel of one sample is the eye ray through its centre") {
  const scene s = still_life();
  const tracer<float> t(s);
  const picture p = t.render(16, 12, 4);
  const film<float> film(frame_of(s.view, 16, 12));
  for (std::uint32_t y = 0; y < 12; ++y)
    for (std::uint32_t x = 0; x < 16; ++x) {
      const auto c = t.pixel(film, float(x) + 0.5f, float(y) + 0.5f, 4);
      for (int k = 0; k < 4; ++k) CHECK(p.at(x, y)[k] == c[std::size_t(k)]);
    }
}

TEST_CASE("a picture without trees has the same bits: glass, shadows, a mesh under the identity") {
  scene plain;
  plain.view.position = {1, 1, 3};
  test::add(plain, generate("torus_knot", {{"segments", 40}, {"sides", 6}}), material{}, {});
  plain.lights.resize(1);
  plain.lights[0].position = {2, 4, 3};
  for (const scene& s : {still_life(), plain}) {
    const tracer<float> single(s);
    CHECK(single.render_without_tree(32, 24, 4).rgba == single.render(32, 24, 4).rgba);
    const tracer<double> oracle(s);
    CHECK(oracle.render_without_tree(16, 12, 4).rgba == oracle.render(16, 12, 4).rgba);
  }
}

TEST_CASE("samples are the mean over a regular grid, alpha too") {
  scene s = still_life();
  s.samples = 2;
  const tracer<double> t(s);
  const picture p = t.render(10, 8, 3);
  const film<double> film(frame_of(s.view, 10, 8));
  bool partly = false;
  for (std::uint32_t y = 0; y < 8; ++y)
    for (std::uint32_t x = 0; x < 10; ++x) {
      std::array<double, 4> mean{};
      for (const double j : {0.25, 0.75})
        for (const double i : {0.25, 0.75}) {
          const auto c = t.pixel(film, x + i, y + j, 3);
          for (std::size_t k = 0; k < 4; ++k) mean[k] += c[k] / 4;
        }
      // Sums of four doubles, then one rounding to float.
      for (std::size_t k = 0; k < 4; ++k)
        CHECK(std::abs(double(p.at(x, y)[k]) - mean[k]) <= 0x1p-23 * (mean[k] + 1));
      partly = partly || (p.at(x, y)[3] > 0.5f && p.at(x, y)[3] < 1);
    }
  CHECK(partly);
}

TEST_CASE("progress counts pixels to the end, and false stops the work") {
  const scene s = still_life();
  const tracer<float> t(s);
  std::vector<std::uint64_t> calls;
  t.render(6, 4, 1, [&](std::uint64_t done, std::uint64_t total) {
    CHECK(total == 24);
    calls.push_back(done);
    return true;
  });
  CHECK(calls == std::vector<std::uint64_t>{6, 12, 18, 24});
  const picture p = t.render(6, 4, 1, [](std::uint64_t done, std::uint64_t) { return done < 12; });
  CHECK(p.at(0, 1)[3] > 0);
  for (std::uint32_t x = 0; x < 6; ++x) CHECK(p.at(x, 2)[3] == 0);
}

TEST_CASE("more depth adds bounces: 0 shows no mirror image") {
  const scene s = still_life();
  const tracer<double> t(s);
  const film<double> film(frame_of(s.view, 16, 12));
  const auto flat = t.pixel(film, 10.5, 6, 0), deep = t.pixel(film, 10.5, 6, 1);
  CHECK(flat[0] == 0);
  CHECK(deep[2] > 0);
}

TEST_CASE("float and double have the same signature but near edges, and colours as close") {
  const scene s = still_life();
  const tracer<float> a(s);
  const tracer<double> b(s);
  const film<float> fa(frame_of(s.view, 64, 48));
  const film<double> fb(frame_of(s.view, 64, 48));
  int differ = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const float px = float(x) + 0.5f, py = float(y) + 0.5f;
      if (a.signature(fa, px, py, 3) != b.signature(fb, double(px), double(py), 3)) {
        ++differ;
        continue;
      }
      const auto ca = a.pixel(fa, px, py, 3);
      const auto cb = b.pixel(fb, double(px), double(py), 3);
      // Up to three bounces off balls whose facets are 0.15 wide: each turns an error of u * 10 at
      // most a hundredfold, and colours change by less than 10 a unit of direction or place.
      for (std::size_t k = 0; k < 3; ++k)
        REQUIRE(std::abs(double(ca[k]) - cb[k]) < 0x1p-24 * 10 * 1e3 * 10);
    }
  // Rays that split at glass meet tens of triangles; an edge is nearer than that error for few.
  CHECK(differ < 64 * 48 / 50);
}

TEST_CASE("a signature tells surfaces apart and is the same inside one") {
  scene s;
  test::add(s, test::unit_triangle(), material{});
  const tracer<double> t(s);
  // The film's x and y are the world's at distance 1 from the eye at z = 1.
  const film<double> film(camera_frame{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, 1, 0}});
  CHECK(t.signature(film, 0.2, 0.2, 0) == t.signature(film, 0.3, 0.1, 0));
  CHECK(t.signature(film, 0.2, 0.2, 0) != t.signature(film, -0.2, 0.2, 0));
  CHECK(t.signature(film, -0.2, 0.2, 0) == t.signature(film, -0.3, 0.2, 0));
  light l;
  l.position = {0.2, 0.2, 2};
  s.lights.push_back(l);
  const tracer<double> open(s);
  test::add(s, test::unit_triangle(), material{}, transform::translate({0, 0, 1.5}));
  const tracer<double> shaded(s);
  CHECK(open.signature(film, 0.2, 0.2, 0) != shaded.signature(film, 0.2, 0.2, 0));
}
