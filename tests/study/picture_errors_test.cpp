#include "study/picture_errors.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "tracer/scenes_helper.hpp"

using namespace facet;

namespace {

/// A white square before black: its side lies at 2^-7 of a pixel beyond the middle of pixel 16 of
/// 32, seen from 5 units at 40 degrees.
scene square() {
  scene s;
  s.materials.emplace_back();
  s.materials[0].Ke = {1, 1, 1};
  const double half = std::tan(20 * 3.14159265358979 / 180) * 5;
  const auto side = float((16.5 / 16 - 1) * half + half / 16 / 128);
  mesh m;
  m.positions = {{-1, -1, 0}, {side, -1, 0}, {side, 1, 0}, {-1, 1, 0}};
  m.indices = {0, 1, 2, 0, 2, 3};
  s.meshes.push_back(m);
  s.instances.push_back({});
  return s;
}

}  // namespace

TEST_CASE("the expected picture is the double reference's, bit for bit, on any number of threads") {
  scene s = test::every_feature();
  s.samples = 2;
  const reference::tracer<double> exact(s);
  study::picture_oracle oracle(s, exact, 24, 16, 3, 3);
  CHECK(study::differing_pixels(oracle.expected(), exact.render(24, 16, 3)) == 0);
}

TEST_CASE("equal pictures have no errors") {
  const scene s = square();
  const reference::tracer<double> exact(s);
  study::picture_oracle oracle(s, exact, 32, 32, 0, 1);
  const auto e = oracle.judge(oracle.expected(), oracle.expected());
  CHECK(e.all.max == 0);
  CHECK(e.asked == 0);
  CHECK(e.flip_mean == 0);
  CHECK(e.other_bits == 0);
}

TEST_CASE("a silhouette is a pixel that the reference has nearby: not any value at an edge") {
  const scene s = square();
  const reference::tracer<double> exact(s);
  study::picture_oracle oracle(s, exact, 32, 32, 0, 1);
  const picture expected = oracle.expected();
  REQUIRE(expected.at(16, 15)[0] == 1);
  REQUIRE(expected.at(17, 15)[0] == 0);

  picture tipped = expected;
  for (int c = 0; c < 3; ++c) tipped.at(16, 15)[c] = 0;
  auto e = oracle.judge(tipped, expected);
  CHECK(e.asked == 1);
  CHECK(e.silhouettes == 1);
  CHECK(e.all.max == 1);
  CHECK(e.rest.max == 0);
  CHECK(e.rest.pixels() == 32 * 32 - 1);
  CHECK(e.all.pixels_off_displayed == 1);
  CHECK(e.off_displayed_explained == 1);
  CHECK(e.flip_mean > 0);
  CHECK(e.other_bits == 1);

  picture wrong = expected;
  wrong.at(16, 15)[1] = 2;     // clamped: what a screen shows is right
  wrong.at(12, 15)[0] = 0.5f;  // inside
  wrong.at(17, 15)[0] = 1;     // beyond the edge, but not near enough
  wrong.at(9, 9)[2] = NAN;
  e = oracle.judge(wrong, expected);
  CHECK(e.asked == 3);
  CHECK(e.silhouettes == 0);
  CHECK(e.off_displayed_explained == 0);
  CHECK(e.rest.pixels_off == 3);
}

TEST_CASE("an object that only some samples of a pixel meet may tip in each of them") {
  scene s = square();
  s.samples = 2;
  const reference::tracer<double> exact(s);
  // With two samples a side the edge that lay beside the middle of a pixel lies beside no sample,
  // and a quarter of a pixel to either side does.
  study::picture_oracle oracle(s, exact, 32, 32, 0, 1);
  picture found = oracle.expected();
  REQUIRE(found.at(16, 15)[0] == 0.5f);
  found.at(16, 15)[0] = found.at(16, 15)[1] = found.at(16, 15)[2] = 0.75f;
  CHECK(oracle.judge(found, found).silhouettes == 0);
}

TEST_CASE("of very many pixels that are off, some are asked") {
  const scene s = square();
  const reference::tracer<double> exact(s);
  study::picture_oracle oracle(s, exact, 64, 64, 0, 2);
  picture grey = oracle.expected();
  for (float& v : grey.rgba) v = 0.5f;
  const auto e = oracle.judge(grey, oracle.expected());
  CHECK(e.all.pixels_off == 64 * 64);
  CHECK(e.asked == study::most_asked);
  CHECK(e.silhouettes <= e.asked);
}
