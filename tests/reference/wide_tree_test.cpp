// The tree: every box in one leaf, every node around its children, depth bounded for any input.
#include "reference/wide_tree.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <set>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

/// Walks everything below `child` and gives the union of the boxes found there.
box3f check_below(const wide_tree& t, std::span<const box3f> boxes, unsigned leaf_size,
                  std::uint32_t child, unsigned depth, std::set<std::uint32_t>& seen) {
  REQUIRE(depth <= sah_max_depth);
  box3f all;
  if (child & leaf_bit) {
    const auto leaf = t.leaf(child & ~leaf_bit);
    CHECK(leaf.size() >= 1);
    CHECK(leaf.size() <= leaf_size);
    for (const std::uint32_t b : leaf) {
      CHECK(seen.insert(b).second);
      all.add(boxes[b]);
    }
    return all;
  }
  const wide_node& n = t.nodes[child];
  for (std::size_t k = 0; k < tree_width; ++k) {
    if (n.child[k] == no_child) continue;
    const box3f below = check_below(t, boxes, leaf_size, n.child[k], depth + 1, seen);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      CHECK(n.plane[2 * axis][k] == below.lo[int(axis)]);
      CHECK(n.plane[2 * axis + 1][k] == below.hi[int(axis)]);
    }
    all.add(below);
  }
  return all;
}

void check(std::span<const box3f> boxes, unsigned leaf_size) {
  const wide_tree t(boxes, leaf_size);
  if (boxes.empty()) {
    CHECK(t.root == no_child);
    CHECK(t.leaf_count() == 0);
    return;
  }
  std::set<std::uint32_t> seen;
  check_below(t, boxes, leaf_size, t.root, 0, seen);
  CHECK(seen.size() == boxes.size());
}

}  // namespace

TEST_CASE("any number of boxes, from none on, lies in leaves once") {
  test::random r(1);
  for (const std::size_t n : {0, 1, 2, 3, 4, 5, 8, 9, 127, 128, 129, 3000}) {
    std::vector<box3f> boxes(n);
    for (box3f& b : boxes) {
      b.add(r.in_cube());
      b.add(b.lo + r.in_cube() * 0.1f);
    }
    check(boxes, 4);
    check(boxes, 1);
  }
}

TEST_CASE("equal boxes, flat ones and geometric series keep the depth bounded") {
  for (const std::size_t n : {5, 200, 5000}) {
    std::vector<box3f> equal(n, {{0, 0, 0}, {1, 1, 1}}), points(n, {{1, 1, 1}, {1, 1, 1}});
    check(equal, 4);
    check(points, 1);
    std::vector<box3f> series;
    for (std::size_t i = 0; i < n; ++i) {
      const float x = std::exp2(59.0f - float(i % 180)) * (1 + float(i) / float(n));
      series.push_back({{-x, 0, -x}, {x, x, 0}});
      series.push_back({{x, x, x}, {x, x, x}});
    }
    check(series, 4);
    check(series, 1);
  }
}
