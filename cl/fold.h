// How a binary tree is folded into nodes of up to eight children: of all ways, the one with the least sum of
// areas over wide nodes, which is what they cost a ray (Ylitie, Karras and Laine, HPG 2017). The binary
// tree's leaves stay leaves.
//
// A subtree that has k places among the children of a wide node above either is one child, a wide node
// itself or a leaf, or its two sides share the places, or it makes do with fewer.
#ifndef FACET_FOLD_H
#define FACET_FOLD_H

#include "bounds.h"

#define WIDTH 8u

// FoldPlan.left, at k - 1: what the left side takes of k places; 0: fewer places, or one, are as good. At
// 0, the left side's places of WIDTH where the node is a wide node itself.
static inline uint places_of(uint left, uint k) { return left >> 4u * (k - 1u) & 15u; }

// FoldCost, in registers.
typedef struct {
  float8 area;
  uint8 nodes, depth;
} Ways;

// A leaf costs no wide node, however many places it has.
static inline Ways ways_of_leaf(void) {
  Ways w;
  w.area = (float8)(0.0f);
  w.nodes = w.depth = (uint8)(0u);
  return w;
}

static inline Ways ways_at(__global const FoldCost* cost) {
  Ways w;
  w.area = vload8(0, cost->area);
  w.nodes = vload8(0, cost->nodes);
  w.depth = vload8(0, cost->depth);
  return w;
}

// The fewest places that cost as little: lane k - 1 becomes the best of lanes 0 to k - 1, the lower one
// of equals. Takes from the lane `by` lower, where there is one; `from` says from which lane all in all.
#define TAKE_FEWER(area, from, lane, by, SHIFTED)                         \
  {                                                                       \
    const int8 takes = ((area).SHIFTED <= (area)) & ((lane) >= (uint8)(by)); \
    (area) = takes ? (area).SHIFTED : (area);                             \
    (from) = takes ? (from).SHIFTED : (from);                             \
  }

// From what the children cost to what the node does, at `cost`. No area is above FLT_MAX here, as what
// overflows is not chosen: then each side has half of the places.
APART void plan_node(__global const Node* nodes, uint node, Ways left, Ways right,
                     __global FoldPlan* plans, __global FoldCost* cost) {
  const uint8 lane = (uint8)(0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u);
  float left_area[WIDTH];
  vstore8(left.area, 0, left_area);

  // Lane k - 1: k places, shared.
  float8 area = (float8)(FLT_MAX), right_area = right.area;
  uint8 share = (uint8)(0u, 1u, 1u, 2u, 2u, 3u, 3u, 4u);
  for (uint k = 1u; k < WIDTH; ++k) {
    right_area = (float8)(FLT_MAX, right_area.s0123, right_area.s456);
    const float8 both = left_area[k - 1u] + right_area;
    const int8 is_less = both < area;
    area = is_less ? both : area;
    share = is_less ? (uint8)(k) : share;
  }
  const uint8 l = share - 1u, r = lane - share;
  Ways best;
  best.nodes = picked(left.nodes, l) + picked(right.nodes, r);
  best.depth = max(picked(left.depth, l), picked(right.depth, r));
  const uint own = share.s7;
  area.s0 = half_area(joined(side_bounds(&nodes[node], 0u), side_bounds(&nodes[node], 1u))) + area.s7;
  best.nodes.s0 = 1u + best.nodes.s7;
  best.depth.s0 = 1u + best.depth.s7;

  uint8 from = lane;
  TAKE_FEWER(area, from, lane, 1u, s00123456)
  TAKE_FEWER(area, from, lane, 2u, s00012345)
  TAKE_FEWER(area, from, lane, 4u, s00000123)
  best.area = area;
  best.nodes = picked(best.nodes, from);
  best.depth = picked(best.depth, from);
  share = from < lane ? (uint8)(0u) : share;
  share.s0 = own;
  share <<= (uint8)(0u, 4u, 8u, 12u, 16u, 20u, 24u, 28u);
  const uint4 halves = share.lo | share.hi;
  const uint2 quarters = halves.lo | halves.hi;

  vstore8(best.area, 0, cost->area);
  vstore8(best.nodes, 0, cost->nodes);
  vstore8(best.depth, 0, cost->depth);
  plans[node].left = quarters.x | quarters.y;
  plans[node].nodes = best.nodes.s0;
  uint leaves = 0u;
  for (uint side = 0u; side < 2u; ++side) {
    const uint child = nodes[node].child[side];
    leaves += child & FACET_LEAF_BIT ? 1u : plans[child].leaves;
  }
  plans[node].leaves = leaves;
}

// Writes the wide node that stands for `node`, whose place and leaves are known; names its leaves in
// `leaves`, tells its other children theirs, and gives these, from the left. As children, wide nodes are
// counted from first_node on and leaves from first_leaf on.
APART uint emit_node(__global const Node* nodes, __global FoldPlan* plans, uint node,
                     __global WideNode* wide, __global uint* leaves, uint first_node,
                     uint first_leaf, uint* inner) {
  __global WideNode* to = &wide[first_node + plans[node].nodes];
  uint at = plans[node].nodes + 1u, leaf = plans[node].leaves, lane = 0u, inner_count = 0u;
  // Subtrees that wait, as the node above and its side, and their places. Each becomes at least one child.
  uint above[WIDTH], side[WIDTH], places[WIDTH], top = 0u;
  const uint own = places_of(plans[node].left, 1u);
  above[top] = node, side[top] = 1u, places[top++] = WIDTH - own;
  above[top] = node, side[top] = 0u, places[top++] = own;
  while (top > 0u) {
    __global const Node* n = &nodes[above[--top]];
    const uint s = side[top], child = n->child[s];
    uint as_child;
    if (child & FACET_LEAF_BIT) {
      leaves[leaf] = child;
      as_child = FACET_LEAF(first_leaf + leaf, 1u);
      ++leaf;
    } else {
      const uint left = plans[child].left;
      uint k = places[top];
      while (k > 1u && places_of(left, k) == 0u) --k;
      if (k > 1u) {
        const uint l = places_of(left, k);
        above[top] = child, side[top] = 1u, places[top++] = k - l;
        above[top] = child, side[top] = 0u, places[top++] = l;
        continue;
      }
      inner[inner_count++] = child;
      as_child = first_node + at;
      const uint nodes_below = plans[child].nodes, leaves_below = plans[child].leaves;
      plans[child].nodes = at;
      plans[child].leaves = leaf;
      at += nodes_below;
      leaf += leaves_below;
    }
    to->x[0][lane] = n->x[0][s], to->x[1][lane] = n->x[1][s];
    to->y[0][lane] = n->y[0][s], to->y[1][lane] = n->y[1][s];
    to->z[0][lane] = n->z[0][s], to->z[1][lane] = n->z[1][s];
    to->child[lane++] = as_child;
  }
  for (; lane < WIDTH; ++lane) {
    to->x[0][lane] = to->y[0][lane] = to->z[0][lane] = INFINITY;
    to->x[1][lane] = to->y[1][lane] = to->z[1][lane] = -INFINITY;
    to->child[lane] = FACET_NONE;
  }
  vstore8((uint8)(0u), 0, to->spare);
  return inner_count;
}

#endif
