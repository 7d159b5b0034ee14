#include "image/compare.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <stdexcept>

#include "image/transfer.hpp"

using namespace facet;

namespace {

picture grey(std::uint32_t width, std::uint32_t height, float value) {
  picture p(width, height);
  for (std::size_t i = 0; i < p.rgba.size(); ++i) p.rgba[i] = i % 4 == 3 ? 1 : value;
  return p;
}

}  // namespace

TEST_CASE("a picture equals itself") {
  const picture p = grey(5, 4, 0.3f);
  const auto d = image::compare(p, p);
  CHECK(d.max == 0);
  CHECK(d.mean == 0);
  CHECK(d.rmse == 0);
  CHECK(std::isinf(d.psnr));
  CHECK(d.pixels_off == 0);
  CHECK(d.pixels_off_displayed == 0);
  CHECK(d.pixels() == 20);
}

TEST_CASE("one channel of one pixel gives the errors that it must, at its place") {
  const picture a = grey(10, 10, 0.25f);
  picture b = a;
  b.at(7, 3)[1] = 0.75f;
  const auto d = image::compare(a, b);
  CHECK(d.max == 0.5);
  // 300 colour values, one off by 0.5: exact in double but for the last division's rounding.
  CHECK(d.mean == doctest::Approx(0.5 / 300).epsilon(1e-15));
  CHECK(d.rmse == doctest::Approx(std::sqrt(0.25 / 300)).epsilon(1e-15));
  CHECK(d.psnr == doctest::Approx(10 * std::log10(1200)).epsilon(1e-14));
  CHECK(d.worst_x == 7);
  CHECK(d.worst_y == 3);
  CHECK(d.pixels_off == 1);
  CHECK(d.share_off() == 0.01);
}

TEST_CASE("brightness that no screen shows is no difference") {
  const auto d = image::compare(grey(3, 3, 1), grey(3, 3, 40));
  CHECK(d.max == 0);
  CHECK(image::compare(grey(3, 3, 0), grey(3, 3, -2)).max == 0);
  CHECK(image::compare(grey(3, 3, 1), grey(3, 3, INFINITY)).max == 0);
}

TEST_CASE("neighbouring levels of 8 bits are not off, two levels are") {
  for (int level = 0; level + 2 < 256; ++level) {
    const float a = float(level) / 255;
    CHECK(image::compare(grey(1, 1, a), grey(1, 1, float(level + 1) / 255)).pixels_off == 0);
    CHECK(image::compare(grey(1, 1, a), grey(1, 1, float(level + 2) / 255)).pixels_off == 1);
  }
}

TEST_CASE("displayed levels are those of the sRGB curve") {
  using image::transfer;
  const float low = image::from_byte(200, transfer::srgb);
  const float next = image::from_byte(201, transfer::srgb);
  const float third = image::from_byte(202, transfer::srgb);
  // One level at the bright end is more than 1/255 in linear light: the two counts differ.
  CHECK(image::compare(grey(1, 1, low), grey(1, 1, next)).pixels_off == 1);
  CHECK(image::compare(grey(1, 1, low), grey(1, 1, next)).pixels_off_displayed == 0);
  CHECK(image::compare(grey(1, 1, low), grey(1, 1, third)).pixels_off_displayed == 1);
}

TEST_CASE("alpha is reported apart: it makes a pixel off and leaves the colour errors alone") {
  const picture a = grey(2, 2, 0.5f);
  picture b = a;
  b.at(1, 0)[3] = 0;
  const auto d = image::compare(a, b);
  CHECK(d.max == 0);
  CHECK(d.rmse == 0);
  CHECK(d.alpha_max == 1);
  CHECK(d.pixels_off == 1);
  CHECK(d.pixels_off_displayed == 1);
}

TEST_CASE("NaN never passes for equal") {
  const picture a = grey(2, 2, 0.5f);
  picture b = a;
  b.at(0, 1)[2] = NAN;
  const auto d = image::compare(a, b);
  CHECK(d.nan_pixels == 1);
  CHECK(d.max == 1);
  CHECK(d.worst_y == 1);
  CHECK(d.pixels_off == 1);
  CHECK(d.pixels_off_displayed == 1);
  const auto both = image::compare(b, b);
  CHECK(both.nan_pixels == 1);
  CHECK(both.pixels_off == 1);
  CHECK(both.max == 0);
}

TEST_CASE("the order of the two pictures does not matter") {
  picture a = grey(8, 8, 0), b = a;
  for (std::size_t i = 0; i < a.rgba.size(); ++i) {
    a.rgba[i] = float((i * 37) % 101) / 100;
    b.rgba[i] = float((i * 53) % 97) / 96;
  }
  const auto ab = image::compare(a, b), ba = image::compare(b, a);
  CHECK(ab.max == ba.max);
  CHECK(ab.mean == ba.mean);
  CHECK(ab.rmse == ba.rmse);
  CHECK(ab.pixels_off == ba.pixels_off);
  CHECK(ab.mean <= ab.rmse);
  CHECK(ab.rmse <= ab.max);
}

TEST_CASE("pictures of different sizes are refused with both sizes") {
  CHECK_THROWS_WITH_AS(image::compare(grey(4, 3, 0), grey(3, 4, 0)),
                       "the pictures differ in size: 4x3 and 3x4", std::invalid_argument);
}

TEST_CASE("empty pictures compare as equal") {
  CHECK(image::compare(picture{}, picture{}).share_off() == 0);
}

TEST_CASE("pixels that are left out count for nothing, not even as equal ones") {
  const picture a = grey(4, 2, 0.5f);
  picture b = a;
  b.at(1, 1)[0] = 1;
  b.at(3, 0)[2] = 0.25f;
  std::vector<bool> left_out(8);
  left_out[5] = true;
  const auto d = image::compare(a, b, left_out);
  CHECK(d.left_out == 1);
  CHECK(d.pixels() == 7);
  CHECK(d.max == 0.25);
  CHECK(d.mean == 0.25 / 21);
  CHECK(d.pixels_off == 1);
}
