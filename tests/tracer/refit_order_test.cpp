#include "tracer/refit_order.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "tracer/layout.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

constexpr std::uint32_t first_node = 1000;

/// `width` a node, named from first_node on.
struct shape {
  std::uint32_t width;
  std::vector<std::uint32_t> children;
};

/// Each node but the root hangs at a random one before it that has a place left.
shape random_shape(std::uint32_t nodes, std::uint32_t width, std::uint64_t seed) {
  test::random r(seed);
  shape s{width, std::vector<std::uint32_t>(std::size_t(width) * nodes, FACET_NONE)};
  std::vector<std::uint32_t> used(nodes, 0);
  for (std::uint32_t n = 1; n < nodes; ++n) {
    std::uint32_t parent = r.below(n);
    while (used[parent] == width) parent = r.below(n);
    s.children[width * parent + used[parent]++] = first_node + n;
  }
  for (std::uint32_t n = 0; n < nodes; ++n)
    if (used[n] < width) s.children[width * n + used[n]] = FACET_LEAF(n, 1u);
  return s;
}

shape chain(std::uint32_t nodes) {
  shape s{2, {}};
  for (std::uint32_t n = 0; n < nodes; ++n) {
    s.children.push_back(FACET_LEAF(n, 1u));
    s.children.push_back(n + 1 < nodes ? first_node + n + 1 : FACET_LEAF(n + 1, 1u));
  }
  return s;
}

/// What a work-item of cl/refit.cl may rely on.
void check(const shape& s, std::uint32_t most) {
  const auto nodes = std::uint32_t(s.children.size() / s.width);
  const refit_order o = order_for_refit(s.children, s.width, first_node, first_node, most);
  REQUIRE(o.nodes.size() == nodes);
  CHECK(std::set<std::uint32_t>(o.nodes.begin(), o.nodes.end()).size() == nodes);
  REQUIRE(o.starts.back() == nodes);
  REQUIRE(o.phases.back() + 1 == o.starts.size());
  std::vector<std::uint32_t> at(nodes), treelet(nodes), phase(nodes);
  std::uint32_t too_large = 0, too_late = 0;
  for (std::uint32_t p = 0; p + 1 < o.phases.size(); ++p)
    for (std::uint32_t t = o.phases[p]; t < o.phases[p + 1]; ++t) {
      too_large += o.starts[t + 1] - o.starts[t] > most || o.starts[t + 1] == o.starts[t];
      for (std::uint32_t k = o.starts[t]; k < o.starts[t + 1]; ++k)
        at[o.nodes[k]] = k, treelet[o.nodes[k]] = t, phase[o.nodes[k]] = p;
    }
  for (std::uint32_t n = 0; n < nodes; ++n)
    for (std::uint32_t c = 0; c < s.width; ++c) {
      const std::uint32_t child = s.children[s.width * n + c];
      if (child & FACET_LEAF_BIT) continue;
      const std::uint32_t below = child - first_node;
      too_late += !(treelet[below] == treelet[n] ? at[below] < at[n] : phase[below] < phase[n]);
    }
  CHECK(too_large == 0);
  CHECK(too_late == 0);
}

}  // namespace

TEST_CASE(
    "each node comes once, after all below it in its treelet, in a later phase than the rest") {
  for (const std::uint32_t nodes : {1u, 2u, 9u, 100u, 3000u})
    for (const std::uint32_t width : {2u, 8u})
      for (const std::uint32_t most : {1u, 8u, 1024u}) {
        CAPTURE(nodes);
        CAPTURE(width);
        CAPTURE(most);
        check(random_shape(nodes, width, nodes + most), most);
      }
  check(chain(500), 8);
}

TEST_CASE("large treelets take few phases") {
  const shape s = random_shape(5000, 8, 3);
  CHECK(order_for_refit(s.children, 8, first_node, first_node, 5000).phases.size() == 2);
  CHECK(order_for_refit(s.children, 8, first_node, first_node, 1024).phases.size() <= 4);
}

TEST_CASE("nodes that nothing leads to, and a root that is a leaf, are left out") {
  shape s = chain(5);
  s.children[2 * 2 + 1] = FACET_LEAF(3u, 3u);  // nodes 3 and 4 are cut off
  const refit_order o = order_for_refit(s.children, 2, first_node, first_node, 8);
  CHECK(o.nodes == std::vector<std::uint32_t>{2, 1, 0});
  const refit_order none = order_for_refit({}, 2, FACET_LEAF(0u, 2u), first_node, 8);
  CHECK(none.nodes.empty());
  CHECK(none.phases.size() == 1);
}
