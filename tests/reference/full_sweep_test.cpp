// The yardstick: its splits are the best there are, its leaves pay, its depth is bounded.
#include "reference/full_sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reference/scenes.hpp"

using namespace facet;
using namespace facet::reference;

namespace {

double area(const box3f& b) { return box3d{vec3d(b.lo), vec3d(b.hi)}.half_area(); }

box3f around(std::span<const box3f> boxes, const std::vector<std::uint32_t>& some) {
  box3f all;
  for (const std::uint32_t b : some) all.add(boxes[b]);
  return all;
}

/// Cost times half area below `node`; checks boxes and leaves, and gathers who is there.
double check_below(const sah_tree& t, std::span<const box3f> boxes, unsigned most_in_leaf,
                   std::uint32_t node, unsigned depth, std::vector<std::uint32_t>& below) {
  REQUIRE(depth <= sah_max_depth);
  const sah_node& n = t.nodes[node];
  double cost = area(n.box);
  if (n.is_leaf()) {
    REQUIRE(n.count <= most_in_leaf);
    below.assign(t.order.begin() + n.first, t.order.begin() + n.first + n.count);
    cost *= n.count;
  } else {
    std::vector<std::uint32_t> right;
    cost += check_below(t, boxes, most_in_leaf, n.first, depth + 1, below) +
            check_below(t, boxes, most_in_leaf, n.first + 1, depth + 1, right);
    below.insert(below.end(), right.begin(), right.end());
    if (below.size() <= most_in_leaf) CHECK(cost < area(n.box) * double(below.size()));
  }
  CHECK(n.box == around(boxes, below));
  return cost;
}

double check(std::span<const box3f> boxes, unsigned most_in_leaf = 4) {
  const sah_tree t = sweep_sah(boxes, most_in_leaf);
  if (boxes.empty()) {
    CHECK(t.nodes.empty());
    return 0;
  }
  std::vector<std::uint32_t> all;
  const double cost = check_below(t, boxes, most_in_leaf, 0, 0, all);
  CHECK(all.size() == boxes.size());
  CHECK(std::set<std::uint32_t>(all.begin(), all.end()).size() == boxes.size());
  return cost;
}

std::vector<box3f> random_boxes(std::size_t n, float size) {
  test::random r(n);
  std::vector<box3f> boxes(n);
  for (box3f& b : boxes) {
    b.add(r.in_cube());
    b.add(b.lo + r.in_cube() * size);
  }
  return boxes;
}

/// The least of half area times count over both sides, by trying every place anew.
double least_split(std::span<const box3f> boxes) {
  double least = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<std::uint32_t> order(boxes.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return boxes[a].centre()[axis] < boxes[b].centre()[axis];
    });
    for (auto at = order.begin() + 1; at != order.end(); ++at) {
      const std::vector<std::uint32_t> left(order.begin(), at), right(at, order.end());
      least = std::min(least, area(around(boxes, left)) * double(left.size()) +
                                  area(around(boxes, right)) * double(right.size()));
    }
  }
  return least;
}

}  // namespace

TEST_CASE("full sweep: any number of boxes lies in leaves once, and each leaf pays") {
  for (const std::size_t n : {0, 1, 2, 3, 4, 5, 8, 9, 100, 3000})
    for (const unsigned most : {1u, 4u, 16u}) check(random_boxes(n, 0.1f), most);
}

TEST_CASE("full sweep: the root is split at the best of all places") {
  for (std::size_t n = 5; n < 40; ++n) {
    const auto boxes = random_boxes(n, 0.5f);
    const sah_tree t = sweep_sah(boxes, 1);
    double found = 0;
    for (const std::uint32_t child : {t.nodes[0].first, t.nodes[0].first + 1}) {
      std::vector<std::uint32_t> below;
      check_below(t, boxes, 1, child, 1, below);
      found += area(t.nodes[child].box) * double(below.size());
    }
    // The same products and one sum each: the order of two summands does not matter.
    CHECK(found == least_split(boxes));
  }
}

TEST_CASE("full sweep: a leaf is made where a node would not pay") {
  // Four equal boxes: one leaf costs 4, any split 1 more.
  CHECK(sweep_sah(std::vector<box3f>(4, {{0, 0, 0}, {1, 1, 1}})).nodes.size() == 1);
  // Two unit cubes 9 apart: a leaf would cost 2 * (10 + 10 + 1), the split 21 + 2 * 3.
  const std::vector<box3f> apart{{{0, 0, 0}, {1, 1, 1}}, {{9, 0, 0}, {10, 1, 1}}};
  CHECK(sweep_sah(apart).nodes.size() == 3);
  CHECK(check(apart) == 27);
}

TEST_CASE("full sweep: it is no worse than the binned builder") {
  const auto boxes = random_boxes(20000, 0.02f);
  const sah_tree binned = build_sah(boxes, 1);
  std::vector<std::uint32_t> all;
  double cost = 0;
  for (const sah_node& n : binned.nodes) cost += area(n.box);
  CHECK(check(boxes, 1) <= cost);
}

TEST_CASE("full sweep: equal boxes, points and geometric series keep the depth bounded") {
  for (const std::size_t n : {5, 200, 5000}) {
    check(std::vector<box3f>(n, {{0, 0, 0}, {1, 1, 1}}));
    check(std::vector<box3f>(n, {{1, 1, 1}, {1, 1, 1}}), 1);
    std::vector<box3f> series;
    for (std::size_t i = 0; i < n; ++i) {
      const float x = std::exp2(59.0f - float(i % 180)) * (1 + float(i) / float(n));
      series.push_back({{-x, 0, -x}, {x, x, 0}});
    }
    check(series, 1);
  }
}
