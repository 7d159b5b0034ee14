// Costs and counts of trees made by hand.
#include "study/tree_quality.hpp"

#include <doctest/doctest.h>

using namespace facet;
using namespace facet::study;
using facet::tracer::plain_tree;

namespace {

box3f box(float lo, float hi) { return {{lo, 0, 0}, {hi, 1, 1}}; }

/// Three children, one of them inner. A box from a to b has half the area 2 * (b - a) + 1.
plain_tree by_hand() {
  plain_tree t;
  t.nodes = {{box(0, 10), false, 1, 3}, {box(0, 1), true, 0, 2}, {box(2, 4), true, 2, 1},
             {box(5, 10), false, 4, 2}, {box(5, 6), true, 3, 1}, {box(9, 10), true, 4, 3}};
  t.primitives = {6, 5, 4, 3, 2, 1, 0};
  t.bytes = 700;
  return t;
}

}  // namespace

TEST_CASE("a tree made by hand has the cost and the counts that a hand works out") {
  const tree_quality q = quality_of(by_hand());
  // Half areas: 21; 3, 5, 11; 3, 3. Inner nodes 21 + 11, leaves 2 * 3 + 1 * 5 + 1 * 3 + 3 * 3.
  CHECK(q.sah_cost == (21.0 + 11 + 6 + 5 + 3 + 9) / 21);
  CHECK(q.visits == (21.0 + 3 + 5 + 11 + 3 + 3) / 21);
  CHECK(q.primitives == 7);
  CHECK(q.inner_nodes == 2);
  CHECK(q.leaves == 4);
  CHECK(q.depth == 2);
  CHECK(q.most_in_leaf == 3);
  CHECK(q.primitives_a_leaf() == 1.75);
  CHECK(q.bytes_a_primitive == 100);
}

TEST_CASE("the best leaves are subtrees that do not pay, of so many primitives at most") {
  // Below the last child 11 + 3 + 9 = 23 stand against 4 * 11 = 44 as a leaf.
  CHECK(cost_with_best_leaves(by_hand(), 4) == 55.0 / 21);
  // With boxes nearly as large as their node's the leaf is the cheaper: 44 against 11 + 9 + 27.
  plain_tree t = by_hand();
  t.nodes[4].box = box(5, 9), t.nodes[5].box = box(6, 10);
  CHECK(quality_of(t).sah_cost == (21.0 + 6 + 5 + 11 + 9 + 27) / 21);
  CHECK(cost_with_best_leaves(t, 4) == (21.0 + 6 + 5 + 44) / 21);
  CHECK(cost_with_best_leaves(t, 3) == quality_of(t).sah_cost);
  // All seven as one leaf cost 7 * 21, more than anything above.
  CHECK(cost_with_best_leaves(t, 7) == (21.0 + 6 + 5 + 44) / 21);
}

TEST_CASE("a lone leaf costs its primitives, with or without a box; no tree and no area nothing") {
  plain_tree t;
  t.nodes = {{{}, true, 0, 5}};
  t.primitives = {0, 1, 2, 3, 4};
  CHECK(quality_of(t).sah_cost == 5);
  CHECK(quality_of(t).visits == 1);
  CHECK(quality_of(t).depth == 0);
  CHECK(cost_with_best_leaves(t, 4) == 5);
  CHECK(quality_of({}).sah_cost == 0);
  CHECK(cost_with_best_leaves({}, 4) == 0);
  t.nodes = {{{{1, 1, 1}, {1, 1, 1}}, false, 1, 2},
             {{{1, 1, 1}, {1, 1, 1}}, true, 0, 2},
             {{{1, 1, 1}, {1, 1, 1}}, true, 2, 3}};
  CHECK(quality_of(t).sah_cost == 0);
  CHECK(cost_with_best_leaves(t, 4) == 0);
}
