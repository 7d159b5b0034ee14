#include "study/shape.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace facet::study;

namespace {

bool has(const std::vector<shape>& all, shape s) {
  return std::find(all.begin(), all.end(), s) != all.end();
}

}  // namespace

TEST_CASE("all shapes: squares, rows, columns and rectangles from 1x1 to the limit, then driver") {
  const std::vector<shape> all = all_shapes(1024);
  CHECK(all.size() == 66 + 1);  // widths 2^a, heights 2^b with a + b <= 10, and the driver's
  CHECK(all.front() == shape{1, 1});
  CHECK(all.back().is_driver());
  for (const shape s : {shape{32, 32}, shape{1024, 1}, shape{1, 1024}, shape{16, 4}, shape{4, 16}})
    CHECK(has(all, s));
  for (const shape s : all) CHECK(s.items() <= 1024);
  CHECK(!has(all, {64, 32}));
  // Where the limit is no power of two.
  CHECK(has(all_shapes(1000), {1, 512}));
  CHECK(!has(all_shapes(1000), {1, 1024}));
}

TEST_CASE("shapes are read as they are written") {
  const std::vector<shape> some = parse_shapes("8x8,16x4,driver,3x5", 64);
  CHECK(some == std::vector<shape>{{8, 8}, {16, 4}, {}, {3, 5}});
  for (const shape s : some) CHECK(parse_shapes(s.text(), 64) == std::vector<shape>{s});
  CHECK(parse_shapes("all", 64) == all_shapes(64));
  // Named shapes are not limited here: the kernel says what it cannot run, and why.
  CHECK(parse_shapes("64x64", 64).size() == 1);
}

TEST_CASE("what is no shape is named, with what is allowed") {
  for (const char* text : {"", "8", "8x", "x8", "8x8x8", "0x4", "4x0", "-1x1", "8X8", "8x8,", "oak",
                           "8x8,all", "65537x1", "99999999999999999999x1"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(parse_shapes(text, 64), doctest::Contains("WIDTHxHEIGHT"), shape_error);
  }
  CHECK_THROWS_WITH_AS(parse_shapes("8x8,oak", 64), doctest::Contains("\"oak\""), shape_error);
  CHECK_THROWS_WITH_AS(parse_shapes("8x8,4x4,8x8", 64), doctest::Contains("8x8 twice"),
                       shape_error);
}
