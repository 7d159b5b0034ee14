#include "tracer/fold.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>

#include "tracer/device_helper.hpp"
#include "tracer/fold_helper.hpp"
#include "tracer/kernels.hpp"

using namespace facet;
using namespace facet::tracer;
using test::content;
using test::folded;
using test::host_fold;
using test::host_node_tree;
using test::made_tree;

namespace {

constexpr std::uint32_t first_node = 3, first_leaf = 5;

folder& device_folder() {
  static folder f(test::queue(), kernel_sources(), tuning_for(test::device()));
  return f;
}

host_fold folded_on_device(const host_node_tree& from) {
  node_tree tree{runtime::buffer<Node>(from.nodes.data(), from.nodes.size()),
                 runtime::buffer<std::uint32_t>(1), std::uint32_t(from.nodes.size()), from.root};
  fold_plan plan = device_folder().plan(tree);
  runtime::buffer<WideNode> nodes(first_node + plan.nodes);
  runtime::buffer<std::uint32_t> leaves(plan.leaves);
  host_fold to;
  to.root = device_folder().emit(tree, plan, nodes, first_node, leaves, first_leaf);
  to.nodes = content(nodes);
  to.nodes.erase(to.nodes.begin(), to.nodes.begin() + first_node);
  to.leaves = content(leaves);
  to.depth = plan.depth;
  return to;
}

void check_fold(const host_node_tree& from) {
  const host_fold expected = folded(from, first_node, first_leaf), found = folded_on_device(from);
  CHECK(found.root == expected.root);
  CHECK(found.depth == expected.depth);
  CHECK(found.leaves == expected.leaves);
  REQUIRE(found.nodes.size() == expected.nodes.size());
  std::size_t differing = 0;
  for (std::size_t i = 0; i < found.nodes.size(); ++i)
    differing += std::memcmp(&found.nodes[i], &expected.nodes[i], sizeof(WideNode)) != 0;
  CHECK(differing == 0);
}

Box box_at(vec3f lo, vec3f size) {
  return {{lo.x, lo.y, lo.z}, 0, {lo.x + size.x, lo.y + size.y, lo.z + size.z}, 0};
}

std::function<Box()> random_boxes(test::random& r) {
  return [&r] {
    const vec3f lo = r.in_cube();
    return box_at(lo, {r.uniform() * 0.2f, r.uniform() * 0.2f, r.uniform() * 0.2f});
  };
}

test::split anywhere(test::random& r) {
  return [&r](std::uint32_t n) { return 1 + r.below(n - 1); };
}

/// The areas of wide nodes where of each one's children the largest is opened until they are eight.
double opened_largest_first(const host_node_tree& t, std::uint32_t i) {
  struct child {
    std::uint32_t name;
    float area;
  };
  const auto is_leaf = [](const child& c) { return (c.name & FACET_LEAF_BIT) != 0; };
  const Node& n = t.nodes[i];
  std::vector<child> children;
  const auto add = [&](const Node& of, std::size_t side) {
    children.push_back({of.child[side], test::half_area(of, side)});
  };
  add(n, 0), add(n, 1);
  while (children.size() < 8) {
    auto largest = children.end();
    for (auto c = children.begin(); c != children.end(); ++c)
      if (!is_leaf(*c) && (largest == children.end() || c->area > largest->area)) largest = c;
    if (largest == children.end()) break;
    const Node& opened = t.nodes[largest->name];
    children.erase(largest);
    add(opened, 0), add(opened, 1);
  }
  double sum = test::half_area(n);
  for (const child& c : children)
    if (!is_leaf(c)) sum += opened_largest_first(t, c.name);
  return sum;
}

double areas(const std::vector<WideNode>& nodes) {
  double sum = 0;
  for (const WideNode& n : nodes) {
    const auto extent = [](const float(&axis)[2][8]) {
      return *std::max_element(axis[1], axis[1] + 8) - *std::min_element(axis[0], axis[0] + 8);
    };
    const double x = extent(n.x), y = extent(n.y), z = extent(n.z);
    sum += x * y + y * z + z * x;
  }
  return sum;
}

}  // namespace

TEST_CASE("fold: the device gives what recursion gives, node for node, of any shape") {
  test::random r(1);
  const test::split half = [](std::uint32_t n) { return n / 2; };
  const test::split one = [](std::uint32_t) { return 1u; };
  const test::split all_but_one = [](std::uint32_t n) { return n - 1; };
  for (std::uint32_t n = 1; n <= 40; ++n)
    for (const test::split& s : {half, one, all_but_one, anywhere(r)}) {
      CAPTURE(n);
      check_fold(made_tree(n, 8, s, random_boxes(r), n));
    }
  for (std::uint32_t n : {300u, 5000u, 20'000u})
    for (const test::split& s : {half, anywhere(r)}) {
      CAPTURE(n);
      check_fold(made_tree(n, 1, s, random_boxes(r), n));
    }
  // Deeper than any stack for a balanced tree; where both sides are nodes, costs wait on every
  // level.
  const test::split two = [](std::uint32_t n) { return std::min(2u, n - 1); };
  check_fold(made_tree(3000, 8, two, random_boxes(r), 7));
  check_fold(made_tree(3000, 8, one, random_boxes(r), 7));
  check_fold(made_tree(3000, 8, all_but_one, random_boxes(r), 7));
}

TEST_CASE("fold: boxes that are equal, flat, points, or whose areas overflow") {
  test::random r(2);
  const std::function<Box()> boxes[] = {
      [] {
        return box_at({1, 2, 3}, {1, 1, 1});
      },
      [] {
        return box_at({1, 2, 3}, {0, 0, 0});
      },
      [&] {
        return box_at({r.uniform(), r.uniform(), 0}, {r.uniform(), r.uniform(), 0});
      },
      [&] {
        return box_at({r.uniform(), 0, 0}, {r.uniform(), 0, 0});
      },
      [&] {
        return box_at(r.in_cube() * 1e30f, {1e20f, 1e20f, 1e20f});
      },
      [&] {
        return box_at(r.in_cube(), {r.below(2) ? 3e38f : 0.1f, 0.1f, 0});
      }};
  for (const auto& box : boxes)
    for (std::uint32_t n : {2u, 9u, 17u, 40u, 1000u}) {
      CAPTURE(n);
      check_fold(made_tree(n, 8, anywhere(r), box, n));
    }
}

TEST_CASE("fold: nodes cost less than where the largest child is opened first") {
  test::random r(3);
  for (std::uint32_t n : {9u, 20u, 100u, 3000u}) {
    CAPTURE(n);
    const host_node_tree t = made_tree(n, 8, anywhere(r), random_boxes(r), n);
    const double simple = opened_largest_first(t, t.root), found = areas(folded_on_device(t).nodes);
    // Sums of at most 3,000 areas of like size in single precision: 3,000 u and less.
    CHECK(found <= simple * (1 + 3000 * 0x1p-24));
    if (n == 3000) CHECK(found < 0.99 * simple);
  }
}
