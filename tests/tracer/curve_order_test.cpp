#include "tracer/curve_order.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <vector>

#include "tracer/built_tree_helper.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;
using test::soup;

namespace {

struct outcome {
  std::vector<std::uint32_t> codes, order, starts;
  std::vector<float> curve;
  std::string kernel;  ///< the first that was launched
};

tuning with_few(std::uint32_t few) {
  tuning t = test::faces()[0];
  t.sort.face = sort_face::serial;
  t.sort.few = few;
  return t;
}

template <class Primitive>
outcome made(curve_order<Primitive>& by, const std::vector<Primitive>& primitives,
             std::uint32_t n) {
  runtime::buffer<Primitive> in(primitives.data(), primitives.size());
  runtime::buffer<Curve> curve(1);
  runtime::buffer<std::uint32_t> codes(n), order(n);
  std::vector<step> steps;
  const std::uint32_t found = by.make(in, n, curve, codes, order, steps);
  outcome o{content(codes), content(order), content(by.starts()), {}, steps.at(0).kernel};
  REQUIRE(o.starts.size() > found);
  o.starts.resize(found + 1);
  const Curve c = content(curve)[0];
  for (std::size_t a = 0; a < 3; ++a)
    o.curve.insert(o.curve.end(), {c.lo[a], c.hi[a], c.scale[a], float(c.mask[a])});
  return o;
}

/// At once, and in steps.
template <class Primitive>
void check_same(const std::vector<Primitive>& primitives, std::uint32_t n) {
  static curve_order<Primitive> at_once(test::queue(), kernel_sources(), with_few(1u << 20)),
      in_steps(test::queue(), kernel_sources(), with_few(0));
  CAPTURE(n);
  const outcome few = made(at_once, primitives, n), many = made(in_steps, primitives, n);
  CHECK(few.kernel == "order_few");
  CHECK(many.kernel == "partial_bounds");
  CHECK(few.codes == many.codes);
  CHECK(few.order == many.order);
  CHECK(few.starts == many.starts);
  CHECK(few.curve == many.curve);
}

}  // namespace

TEST_CASE("one work-item puts few primitives in the order that the steps for many do") {
  for (const std::uint32_t n : {1u, 2u, 31u, 32u, 33u, 64u, 1023u, 1024u, 1025u, 5000u, 70000u})
    check_same(soup(n, 0.02f), n);
}

TEST_CASE("more than a sort's few are put in order at once only to start soon, and not by groups") {
  tuning t = with_few(100);
  CHECK(t.ordered_at_once() == 100);
  t.starts_soon = true;
  CHECK(t.ordered_at_once() == 1u << 18);
  t.sort.few = 1u << 20;
  CHECK(t.ordered_at_once() == 1u << 20);
  t.serial_trees = false;
  CHECK(t.ordered_at_once() == 0);
  t = with_few(100);
  t.starts_soon = true;
  curve_order<texel> soon(test::queue(), kernel_sources(), t);
  CHECK(made(soon, soup(5000, 0.02f), 5000).kernel == "order_few");
}

TEST_CASE("so it does with equal ones, in a row, spaced ever wider") {
  for (const std::uint32_t n : {2u, 33u, 1500u}) {
    std::vector<texel> equal(3 * std::size_t(n), texel{1, 2, 3, 0}), row = soup(n, 0.1f),
                                                                     wider = row;
    for (std::size_t i = 0; i < row.size(); ++i) {
      row[i][1] = row[i][2] = 0;
      for (std::size_t c = 0; c < 3; ++c) wider[i][c] = std::ldexp(wider[i][c], int(i / 3) % 120);
    }
    check_same(equal, n), check_same(row, n), check_same(wider, n);
  }
}

TEST_CASE("so it does with boxes") {
  test::random r(7);
  for (const std::uint32_t n : {1u, 33u, 2000u}) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float x = r.uniform(), y = r.uniform(), z = r.uniform();
      boxes.push_back({{x, y, z}, 0, {x + 0.1f, y + 0.2f, z}, 0});
    }
    check_same(boxes, n);
  }
}

TEST_CASE("few are as many as are sorted by one work-item") {
  curve_order<texel> by(test::queue(), kernel_sources(), with_few(100));
  CHECK(made(by, soup(100, 0.1f), 100).kernel == "order_few");
  CHECK(made(by, soup(101, 0.1f), 101).kernel == "partial_bounds");
  CHECK(made(by, soup(99, 0.1f), 99).kernel == "order_few");
}
