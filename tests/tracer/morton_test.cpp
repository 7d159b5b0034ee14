#include "tracer/morton.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

tracer::morton& codes_of() {
  static tracer::morton m(test::queue(), kernel_sources(), tuning_for(test::device()));
  return m;
}

/// Bit by bit, as the definition reads.
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  std::uint64_t code = 0;
  for (int bit = 20; bit >= 0; --bit)
    code = code << 3 | (x >> bit & 1u) << 2 | (y >> bit & 1u) << 1 | (z >> bit & 1u);
  return code;
}

Box point(vec3f p) { return {{p.x, p.y, p.z}, 0, {p.x, p.y, p.z}, 0}; }

std::vector<std::uint64_t> codes(const std::vector<Box>& boxes) {
  const auto n = std::uint32_t(boxes.size());
  runtime::buffer<Box> in(boxes.data(), n);
  runtime::buffer<std::uint64_t> out(n);
  runtime::buffer<std::uint32_t> order(n);
  codes_of().codes(in, out, order, n);
  const runtime::host_accessor read{out, runtime::read_only};
  const runtime::host_accessor places{order, runtime::read_only};
  for (std::uint32_t i = 0; i < n; ++i) REQUIRE(places[i] == i);
  return {read.begin(), read.end()};
}

}  // namespace

TEST_CASE("codes interleave 21 bits an axis of the place in the smallest cube") {
  test::random r(1);
  std::vector<Box> boxes{point({0, 0, 0}), point({2, 1, 1})};  // the cube has side 2
  for (int i = 0; i < 5000; ++i)
    boxes.push_back(point({2 * r.uniform(), r.uniform(), r.uniform()}));
  const auto found = codes(boxes);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto cell = [](float v) { return std::min(std::uint32_t(v / 2 * 2097152.0f), 2097151u); };
    wrong +=
        found[i] != interleaved(cell(boxes[i].lo[0]), cell(boxes[i].lo[1]), cell(boxes[i].lo[2]));
  }
  CHECK(wrong == 0);
  CHECK(found[0] == 0);
  CHECK((found[1] >> 62) == 1);
}

TEST_CASE("one box, and boxes with one centre, have the code 0") {
  CHECK(codes({point({5, 6, 7})}) == std::vector<std::uint64_t>{0});
  for (std::uint64_t c : codes(std::vector<Box>(3000, point({-1, 2, 3})))) CHECK(c == 0);
}

TEST_CASE("the bounds of triangles are those of their corners") {
  test::random r(2);
  std::vector<texel> corners;
  for (int i = 0; i < 300; ++i) corners.push_back({r.uniform(), -r.uniform(), r.uniform(), 0});
  runtime::buffer<texel> in(corners.data(), corners.size());
  runtime::buffer<Box> out(100);
  codes_of().triangle_boxes(in, out, 100);
  const runtime::host_accessor boxes{out, runtime::read_only};
  for (std::size_t t = 0; t < 100; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const auto [lo, hi] =
          std::minmax({corners[3 * t][c], corners[3 * t + 1][c], corners[3 * t + 2][c]});
      CHECK(boxes[t].lo[c] == lo);
      CHECK(boxes[t].hi[c] == hi);
    }
}
