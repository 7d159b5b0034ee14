#include "tracer/morton.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

Box point(vec3f p) { return {{p.x, p.y, p.z}, 0, {p.x, p.y, p.z}, 0}; }

template <class Primitive>
std::vector<std::uint32_t> codes_of(const std::vector<Primitive>& primitives, std::uint32_t n) {
  morton<Primitive> m(test::queue(), kernel_sources(), tuning_for(test::device()));
  runtime::buffer<Primitive> in(primitives.data(), primitives.size());
  runtime::buffer<Curve> curve(1);
  runtime::buffer<std::uint32_t> out(n);
  std::vector<step> steps;
  m.codes(in, curve, out, n, steps);
  return test::content(out);
}

std::vector<std::uint32_t> codes(const std::vector<Box>& boxes) {
  return codes_of(boxes, std::uint32_t(boxes.size()));
}

}  // namespace

TEST_CASE("each bit of a code halves the longest side of the cells, from the highest on") {
  test::random r(1);
  const std::array<float, 3> extent{4, 1, 2};  // x x z x y z, then in turns
  std::vector<Box> boxes{point({0, 0, 0}), point({4, 1, 2})};
  for (int i = 0; i < 5000; ++i)
    boxes.push_back(point({4 * r.uniform(), r.uniform(), 2 * r.uniform()}));
  const auto found = codes(boxes);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    std::array<double, 3> lo{}, side{extent[0], extent[1], extent[2]};
    std::uint32_t code = 0;
    for (int bit = 0; bit < 32; ++bit) {
      std::size_t axis = side[1] > side[0] ? 1 : 0;
      if (side[2] > side[axis]) axis = 2;
      side[axis] /= 2;
      const bool is_upper = boxes[i].lo[axis] >= lo[axis] + side[axis];
      if (is_upper) lo[axis] += side[axis];
      code = code << 1 | std::uint32_t(is_upper);
    }
    wrong += found[i] != code;  // extents are powers of two: no cell is rounded
  }
  CHECK(wrong == 0);
  CHECK(found[0] == 0);
  CHECK(found[1] == 0xffffffffu);
}

TEST_CASE("axes without extent have no bits; one box, and boxes with one centre, have the code 0") {
  CHECK(codes({point({5, 6, 7})}) == std::vector<std::uint32_t>{0});
  for (std::uint32_t c : codes(std::vector<Box>(3000, point({-1, 2, 3})))) CHECK(c == 0);
  const auto line = codes({point({1, 0, 1}), point({1, 8, 1}), point({1, 4, 1})});
  CHECK(line == std::vector<std::uint32_t>{0, 0xffffff00u, 0x80000000u});
}

TEST_CASE("triangles have the codes of their boxes") {
  test::random r(2);
  std::vector<texel> corners;
  std::vector<Box> boxes;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    for (int k = 0; k < 3; ++k) corners.push_back({r.uniform(), -r.uniform(), r.uniform(), 0});
    Box b{};
    for (std::size_t c = 0; c < 3; ++c) {
      const texel* p = &corners[3 * i];
      b.lo[c] = std::min({p[0][c], p[1][c], p[2][c]});
      b.hi[c] = std::max({p[0][c], p[1][c], p[2][c]});
    }
    boxes.push_back(b);
  }
  CHECK(codes_of(corners, 1000) == codes(boxes));
}
