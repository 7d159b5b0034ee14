#include "image/transfer.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

using namespace facet;
using image::transfer;

TEST_CASE("the linear curve is x255, clamped and rounded to the nearest") {
  CHECK(image::to_byte(-1, transfer::linear) == 0);
  CHECK(image::to_byte(0, transfer::linear) == 0);
  CHECK(image::to_byte(1, transfer::linear) == 255);
  CHECK(image::to_byte(7, transfer::linear) == 255);
  CHECK(image::to_byte(INFINITY, transfer::linear) == 255);
  CHECK(image::to_byte(-INFINITY, transfer::linear) == 0);
  CHECK(image::to_byte(0.5f, transfer::linear) == 128);  // 127.5: halves go up
  CHECK(image::to_byte(std::nextafter(0.5f, 0.0f), transfer::linear) == 127);
  CHECK(image::to_byte(0.4f / 255, transfer::linear) == 0);
  CHECK(image::to_byte(0.6f / 255, transfer::linear) == 1);
}

TEST_CASE("the sRGB curve meets the standard's values and joins where its pieces meet") {
  // IEC 61966-2-1: 0.2140 linear is level 0.5 within the four digits that it prints.
  CHECK(image::srgb_from_linear(0.2140) == doctest::Approx(0.5).epsilon(1e-4));
  CHECK(image::to_byte(0.18f, transfer::srgb) == 118);  // 18% grey: 117.6
  CHECK(image::to_byte(1, transfer::srgb) == 255);
  CHECK(image::to_byte(0, transfer::srgb) == 0);
  // The standard's own break point leaves a jump of 3e-8, far below half a level of 16 bits.
  const double below = image::srgb_from_linear(0.0031308);
  const double above = image::srgb_from_linear(std::nextafter(0.0031308, 1.0));
  CHECK(std::abs(above - below) < 1e-6);
}

TEST_CASE("every level comes back from its linear value, under both curves") {
  for (const transfer curve : {transfer::srgb, transfer::linear})
    for (int level = 0; level < 256; ++level) {
      const float linear = image::from_byte(std::uint8_t(level), curve);
      CHECK(int(image::to_byte(linear, curve)) == level);
    }
}

TEST_CASE("both curves rise from level to level") {
  for (const transfer curve : {transfer::srgb, transfer::linear})
    for (int i = 1; i <= 4096; ++i)
      CHECK(image::to_byte(float(i) / 4096, curve) >= image::to_byte(float(i - 1) / 4096, curve));
}

TEST_CASE("alpha is linear under the sRGB curve") {
  picture p(1, 1);
  for (int c = 0; c < 4; ++c) p.rgba[std::size_t(c)] = 0.18f;
  const auto bytes = image::to_bytes(p, transfer::srgb);
  CHECK(int(bytes[0]) == 118);
  CHECK(int(bytes[3]) == 46);  // 0.18 * 255 = 45.9
}

TEST_CASE("NaN is counted by pixel and refused with the first one's place") {
  picture p(4, 3);
  CHECK(image::nan_count(p) == 0);
  CHECK_NOTHROW(image::refuse_nan(p));
  p.at(2, 1)[0] = p.at(2, 1)[3] = p.at(0, 2)[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK(image::nan_count(p) == 2);
  CHECK_THROWS_WITH_AS(image::refuse_nan(p),
                       "the picture holds NaN in 2 pixels, the first at (2, 1)", image::nan_error);
}

TEST_CASE("infinity is not NaN: it is shown as white") {
  picture p(1, 1);
  p.rgba = {INFINITY, -INFINITY, 0, 1};
  CHECK(image::nan_count(p) == 0);
  CHECK(image::to_bytes(p, transfer::srgb) == std::vector<std::uint8_t>{255, 0, 0, 255});
}
