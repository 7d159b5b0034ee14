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
// of equals. Takes from the lane `by` lower, where there is one; marks the lanes that took.
#define TAKE_FEWER(w, taken, by, SHIFTED)                                                   \
  {                                                                                         \
    const float8 area = (w).area.SHIFTED;                                                   \
    const int8 takes = (area <= (w).area) & ((int8)(0, 1, 2, 3, 4, 5, 6, 7) >= (int8)(by)); \
    (w).area = takes ? area : (w).area;                                                     \
    (w).nodes = takes ? (w).nodes.SHIFTED : (w).nodes;                                      \
    (w).depth = takes ? (w).depth.SHIFTED : (w).depth;                                      \
    taken |= takes;                                                                         \
  }

// From what the children cost to what the node does, at `cost`. No area is above FLT_MAX here, as what
// overflows is not chosen: then each side has half of the places.
APART void plan_node(__global const Node* nodes, uint node, Ways left, Ways right,
                     __global FoldPlan* plans, __global FoldCost* cost) {
  float left_area[WIDTH];
  uint left_nodes[WIDTH], left_depth[WIDTH];
  vstore8(left.area, 0, left_area);
  vstore8(left.nodes, 0, left_nodes);
  vstore8(left.depth, 0, left_depth);

  // Lane k - 1: k places, shared.
  Ways best;
  best.area = (float8)(FLT_MAX);
  best.nodes = left.nodes.s00011223 + right.nodes.s00112233;
  best.depth = max(left.depth.s00011223, right.depth.s00112233);
  uint8 share = (uint8)(0u, 1u, 1u, 2u, 2u, 3u, 3u, 4u);
  for (uint k = 1u; k < WIDTH; ++k) {
    right.area = (float8)(FLT_MAX, right.area.s0123, right.area.s456);
    right.nodes = right.nodes.s00123456;
    right.depth = right.depth.s00123456;
    const float8 area = left_area[k - 1u] + right.area;
    const int8 is_less = area < best.area;
    best.area = is_less ? area : best.area;
    best.nodes = is_less ? left_nodes[k - 1u] + right.nodes : best.nodes;
    best.depth = is_less ? max((uint8)(left_depth[k - 1u]), right.depth) : best.depth;
    share = is_less ? (uint8)(k) : share;
  }
  const uint own = share.s7;
  best.area.s0 = half_area(joined(side_bounds(&nodes[node], 0u), side_bounds(&nodes[node], 1u))) + best.area.s7;
  best.nodes.s0 = 1u + best.nodes.s7;
  best.depth.s0 = 1u + best.depth.s7;

  int8 has_fewer = (int8)(0);
  TAKE_FEWER(best, has_fewer, 1, s00123456)
  TAKE_FEWER(best, has_fewer, 2, s00012345)
  TAKE_FEWER(best, has_fewer, 4, s00000123)
  share = has_fewer ? (uint8)(0u) : share;
  share.s0 = own;
  share <<= (uint8)(0u, 4u, 8u, 12u, 16u, 20u, 24u, 28u);
  const uint4 halves = share.lo | share.hi;
  const uint2 quarters = halves.lo | halves.hi;

  vstore8(best.area, 0, cost->area);
  vstore8(best.nodes, 0, cost->nodes);
  vstore8(best.depth, 0, cost->depth);
  plans[node].left = quarters.x | quarters.y;
  plans[node].nodes = best.nodes.s0;
  const uint l = nodes[node].child[0], r = nodes[node].child[1];
  plans[node].leaves = (l & FACET_LEAF_BIT ? 1u : plans[l].leaves) + (r & FACET_LEAF_BIT ? 1u : plans[r].leaves);
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
