#include "tracer/tree_builder.hpp"

#include "tracer/built_tree_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::checked;
using test::shape;
using test::soup;

namespace {

/// Both faces' trees are sound and the same.
void check(const std::vector<texel>& corners, leaf_rule rule) {
  const auto n = std::uint32_t(corners.size() / 3);
  CAPTURE(n);
  CAPTURE(rule.most);
  const auto at = [&](std::uint32_t i) { return test::box_of(corners, i); };
  for (const tree_kind kind : {tree_kind::binned, tree_kind::levels}) {
    CAPTURE(word_of(kind));
    const shape serial = checked<texel>(0, kind, corners, n, rule, at);
    CHECK((checked<texel>(1, kind, corners, n, rule, at) == serial));
  }
}

}  // namespace

TEST_CASE("trees are sound, and the same from work-items and from groups, in any size") {
  for (const leaf_rule rule : {leaf_rule{2, 4}, block_leaves, leaf_rule{1, 1}}) {
    for (std::uint32_t n = 1; n <= 70; ++n) check(soup(n, 0.1f), rule);
    for (const std::uint32_t n : {255u, 256u, 1000u, 5000u, 33000u}) check(soup(n, 0.02f), rule);
  }
}

TEST_CASE("a level's ranges of several tiles have the same splits") {
  check(soup(150'000, 0.01f), {2, 4});
}

TEST_CASE(
    "degenerate primitives have sound trees: equal, flat, in a row, huge, spaced ever wider") {
  const leaf_rule rule{2, 4};
  for (const std::uint32_t n : {2u, 33u, 1500u}) {
    check(std::vector<texel>(3 * std::size_t(n), texel{1, 2, 3, 0}), rule);
    std::vector<texel> flat = soup(n, 0.1f), row = flat, huge = flat, wider = flat;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      flat[i][1] = 7;
      row[i][1] = row[i][2] = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        huge[i][c] = (huge[i][c] - 0.5f) * 3e38f;
        wider[i][c] = std::ldexp(wider[i][c], int(i / 3) % 120);
      }
    }
    check(flat, rule), check(row, rule), check(huge, rule), check(wider, rule);
  }
}

TEST_CASE("trees over boxes have a box to a leaf") {
  test::random r(5);
  for (const std::uint32_t n : {1u, 2u, 31u, 32u, 33u, 2000u}) {
    std::vector<Box> boxes;
    for (std::uint32_t i = 0; i < n; ++i) {
      const float x = r.uniform(), y = r.uniform(), z = r.uniform();
      boxes.push_back({{x, y, z}, 0, {x + 0.1f, y + 0.2f, z}, 0});
    }
    const auto at = [&](std::uint32_t i) { return boxes[i]; };
    for (const tree_kind kind : {tree_kind::binned, tree_kind::levels}) {
      const shape serial = checked<Box>(0, kind, boxes, n, {1, 1}, at);
      CHECK((checked<Box>(1, kind, boxes, n, {1, 1}, at) == serial));
    }
  }
}
