#include "image/flip.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "image/transfer.hpp"

using namespace facet;

namespace {

/// A picture whose displayed levels are of(x, y, channel).
template <class Levels>
picture shown(std::uint32_t width, std::uint32_t height, Levels&& of) {
  picture p(width, height);
  for (int y = 0; y < int(height); ++y)
    for (int x = 0; x < int(width); ++x) {
      float* rgba = p.at(std::uint32_t(x), std::uint32_t(y));
      for (int c = 0; c < 3; ++c)
        rgba[c] = image::from_byte(std::uint8_t(of(x, y, c)), image::transfer::srgb);
      rgba[3] = 1;
    }
  return p;
}

struct pair {
  picture a, b;
};

/// Noise beside other noise.
pair chaos() {
  const auto level = [](int x, int y, int c, bool is_b) {
    if (c == 0) return (x * 7 + y * 3 + (is_b ? x / 8 % 2 * 20 : 0)) % 256;
    if (c == 1) return (x * x + y * (is_b ? 6 : 5)) % 256;
    return (x * y + 40 + (is_b ? y % 5 : 0)) % 256;
  };
  return {shown(48, 32, [&](int x, int y, int c) { return level(x, y, c, false); }),
          shown(48, 32, [&](int x, int y, int c) { return level(x, y, c, true); })};
}

/// A gradient, and the same with a level or two of dither and one line that is off.
pair ramp() {
  const auto level = [](int x, int y, int c) {
    return c == 0 ? 40 + 2 * x : c == 1 ? 200 - 3 * y : 90 + x + y;
  };
  return {shown(40, 24, level), shown(40, 24, [&](int x, int y, int c) {
            return level(x, y, c) + (c == 0 ? (x + y) % 3 : c == 2 && y == 7 ? -4 : 0);
          })};
}

/// An edge between two colours, moved by a fraction of a pixel.
pair edge() {
  const auto level = [](int x, int y, int c, int at) {
    const int v = 3 * x + y < at ? 230 : 25;
    return c == 0 ? v : c == 1 ? v / 2 : 255 - v;
  };
  return {shown(37, 29, [&](int x, int y, int c) { return level(x, y, c, 70); }),
          shown(37, 29, [&](int x, int y, int c) { return level(x, y, c, 72); })};
}

/// Values of the authors' evaluator (version 1.7). It computes in float, and about 40 roundings lie
/// between levels and filtered colours: as a random walk 6 u = 4e-7 of values up to 100, which
/// moves the colour's error by 0.04 d^-0.3 times as much, and 4e-7 of a feature, whose square root
/// moves by 2e-5 where the features are 10^-4 apart: less than 5e-5 of a pixel's error. A mean of a
/// thousand pixels is off by a thirtieth of that.
void check(const pair& p, double pixels_per_degree, double mean, double max, double first,
           double middle, double last, double other) {
  const image::flip_map m = image::flip(p.a, p.b, pixels_per_degree);
  constexpr double of_pixel = 5e-5, of_mean = 2e-6;
  CHECK(std::abs(m.mean - mean) <= of_mean);
  CHECK(std::abs(m.max - max) <= of_pixel);
  CHECK(std::abs(m.at(0, 0) - first) <= of_pixel);
  CHECK(std::abs(m.at(m.width / 2, m.height / 2) - middle) <= of_pixel);
  CHECK(std::abs(m.at(m.width - 1, m.height - 1) - last) <= of_pixel);
  CHECK(std::abs(m.at(5, 7) - other) <= of_pixel);
}

}  // namespace

TEST_CASE("FLIP is that of the authors' evaluator") {
  const double usual = image::usual_pixels_per_degree;
  check(chaos(), usual, 0.3478623, 0.9682715, 0.0157999, 0.274269, 0.463074, 0.184933);
  check(ramp(), usual, 0.01944156, 0.02942595, 0.00883167, 0.0195282, 0.0294259, 0.0210561);
  check(edge(), usual, 0.07684039, 0.4406873, 0, 0.352628, 0, 0);
}

TEST_CASE("seen from farther away, or on a coarser screen, the filters are others") {
  check(edge(), 20, 0.05218347, 0.9071285, 0, 0.571612, 0, 0);
}

TEST_CASE("equal pictures do not differ, and no pixel differs by less than 0 or more than 1") {
  const pair p = chaos();
  const image::flip_map none = image::flip(p.a, p.a);
  CHECK(none.mean == 0);
  CHECK(none.max == 0);
  // Green and blue are the farthest apart of all colours.
  for (const std::pair<int, int>& of : {std::pair{1, 2}, std::pair{0, 1}}) {
    const picture one = shown(8, 8, [&](int, int, int k) { return k == of.first ? 255 : 0; });
    const picture two = shown(8, 8, [&](int, int, int k) { return k == of.second ? 255 : 0; });
    const image::flip_map m = image::flip(one, two);
    CHECK(*std::min_element(m.error.begin(), m.error.end()) >= 0);
    CHECK(m.max <= 1 + 1e-12);  // a quotient of two equal powers, rounded
  }
  const picture green = shown(8, 8, [](int, int, int k) { return k == 1 ? 255 : 0; });
  const picture blue = shown(8, 8, [](int, int, int k) { return k == 2 ? 255 : 0; });
  CHECK(std::abs(image::flip(green, blue).mean - 1) < 1e-9);
}

TEST_CASE("the order of the two pictures does not matter") {
  const pair p = chaos();
  CHECK(image::flip(p.a, p.b).error == image::flip(p.b, p.a).error);
}

TEST_CASE("what no screen shows does not count: alpha, and brightness beyond 1") {
  pair p{shown(6, 5, [](int, int, int) { return 255; }), {}};
  p.b = p.a;
  p.b.at(2, 2)[3] = 0;
  p.b.at(3, 1)[1] = 7;
  CHECK(image::flip(p.a, p.b).max == 0);
}

TEST_CASE("pictures of different sizes are not compared") {
  CHECK_THROWS_WITH_AS(image::flip(picture(3, 4), picture(4, 3)),
                       "the pictures differ in size: 3x4 and 4x3", std::invalid_argument);
}
