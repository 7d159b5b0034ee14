// From a binary tree (layout.h: Node) to wide nodes, for devices whose work-items are a CPU's threads: one
// walks whole subtrees. Right on any device.
//
// Near the root a single work-item opens the tree, breadth first, until there are enough subtrees to be
// shared out: the binary tree for the plan, which is made from the leaves up, and the wide tree for its nodes,
// which are written from the root down. Each knows its place from the plan's counts, so nodes and leaves
// stand in depth-first order, whoever writes them.
//
// Kernels that follow each other are one, told its step: a CPU's driver takes 30 ms for each, however short.
//
// No walk has a stack, whose size would be a guess: lists are threaded through FoldPlan.next. What subtrees
// cost is wanted by the node above alone, soon after it is known: it stays in few records, which caches hold.
#include "fold.h"

// Nodes that are opened at most; as host/tracer/fold.cpp has them.
#define OPENED_BINARY 128u
#define OPENED_WIDE 73u

// A front is the count of opened nodes, that of all, and those: the opened ones, parents first, then the
// roots of the subtrees below them.
static inline uint subtrees_of(__global const uint* front) { return front[1] - front[0]; }
static inline uint subtree_root(__global const uint* front, uint i) { return front[2u + front[0] + i]; }

static inline void open_tree(__global const Node* nodes, uint root, __global uint* front) {
  __global uint* node = front + 2;
  uint opened = 0u, all = 0u;
  node[all++] = root;
  for (; opened < all && opened < OPENED_BINARY; ++opened)
    for (uint side = 0u; side < 2u; ++side) {
      const uint child = nodes[node[opened]].child[side];
      if (!(child & FACET_LEAF_BIT)) node[all++] = child;
    }
  front[0] = opened;
  front[1] = all;
}

// Records of costs: first RECORDS for each subtree, by height of the stack that they make; then one for each
// node, for those that are higher and for what plan_top reads.
#define RECORDS 64u
#define NODE_RECORDS (RECORDS * (OPENED_BINARY + 1u))

// The record of `node`, if its costs are at that height of the i-th subtree's stack.
static inline __global FoldCost* cost_at(__global FoldCost* costs, uint i, uint height, uint node) {
  return &costs[height < RECORDS ? i * RECORDS + height : NODE_RECORDS + node];
}

static inline void plan_subtree(__global const Node* nodes, __global const uint* front, uint i,
                                __global FoldCost* costs, __global FoldPlan* plans) {
  // Those that wait to be met, last in, first out; then those met, last met first.
  const uint root = subtree_root(front, i);
  uint waiting = root, met = FACET_NONE;
  plans[waiting].next = FACET_NONE;
  while (waiting != FACET_NONE) {
    const uint node = waiting;
    waiting = plans[node].next;
    plans[node].next = met;
    met = node;
    for (uint side = 0u; side < 2u; ++side) {
      const uint child = nodes[node].child[side];
      if (child & FACET_LEAF_BIT) continue;
      fetch_lines(&nodes[child], sizeof(Node));
      plans[child].next = waiting;
      waiting = child;
    }
  }
  // A node comes right after its right side, which comes right after its left one: both are on top of
  // the stack then, as where an expression is computed in reverse Polish notation.
  uint height = 0u;
  for (; met != FACET_NONE; met = plans[met].next) {
    const uint l = nodes[met].child[0], r = nodes[met].child[1];
    Ways left = ways_of_leaf(), right = left;
    if (!(r & FACET_LEAF_BIT)) right = ways_at(cost_at(costs, i, --height, r));
    if (!(l & FACET_LEAF_BIT)) left = ways_at(cost_at(costs, i, --height, l));
    plan_node(nodes, met, left, right, plans,
              met == root ? &costs[NODE_RECORDS + root] : cost_at(costs, i, height, met));
    ++height;
  }
}

static inline Ways ways_of(__global const FoldCost* costs, uint child) {
  return child & FACET_LEAF_BIT ? ways_of_leaf() : ways_at(&costs[NODE_RECORDS + child]);
}

// And how many wide nodes and leaves there are, and nodes on the longest way down.
static inline void plan_top(__global const Node* nodes, uint root, __global const uint* front,
                            __global FoldCost* costs, __global FoldPlan* plans, __global uint* sizes) {
  for (uint i = front[0]; i > 0u; --i) {
    const uint node = front[2u + i - 1u];
    plan_node(nodes, node, ways_of(costs, nodes[node].child[0]), ways_of(costs, nodes[node].child[1]), plans,
              &costs[NODE_RECORDS + node]);
  }
  sizes[0] = plans[root].nodes;
  sizes[1] = plans[root].leaves;
  sizes[2] = costs[NODE_RECORDS + root].depth[0];
}

// First one work-item, then one for each subtree that there may be, then one.
__kernel void plan_fold(__global const Node* nodes, uint root, __global uint* front, __global FoldCost* costs,
                        __global FoldPlan* plans, __global uint* sizes, uint step) {
  const uint i = (uint)get_global_id(0);
  if (step == 0u) open_tree(nodes, root, front);
  else if (step == 2u) plan_top(nodes, root, front, costs, plans, sizes);
  else if (i < subtrees_of(front)) plan_subtree(nodes, front, i, costs, plans);
}

// Wide nodes and leaves count as children from first_node and first_leaf on; `wide` is of all trees, `leaves`
// of this one: the binary tree's leaves, in order.
static inline void emit_top(__global const Node* nodes, uint root, __global FoldPlan* plans,
                            __global uint* front, __global WideNode* wide, __global uint* leaves,
                            uint first_node, uint first_leaf) {
  __global uint* node = front + 2;
  uint inner[WIDTH], opened = 0u, all = 0u;
  node[all++] = root;
  plans[root].nodes = plans[root].leaves = 0u;
  for (; opened < all && opened < OPENED_WIDE; ++opened) {
    const uint count = emit_node(nodes, plans, node[opened], wide, leaves, first_node, first_leaf, inner);
    for (uint k = 0u; k < count; ++k) node[all++] = inner[k];
  }
  front[0] = opened;
  front[1] = all;
}

static inline void emit_subtree(__global const Node* nodes, uint root, __global FoldPlan* plans,
                                __global WideNode* wide, __global uint* leaves, uint first_node, uint first_leaf) {
  uint waiting = root;
  plans[waiting].next = FACET_NONE;
  while (waiting != FACET_NONE) {
    uint inner[WIDTH];
    const uint node = waiting;
    waiting = plans[node].next;
    const uint count = emit_node(nodes, plans, node, wide, leaves, first_node, first_leaf, inner);
    for (uint k = count; k > 0u; --k) {
      fetch_lines(&nodes[inner[k - 1u]], sizeof(Node));
      plans[inner[k - 1u]].next = waiting;
      waiting = inner[k - 1u];
    }
  }
}

// First one work-item, then one for each subtree that there may be.
__kernel void emit_fold(__global const Node* nodes, uint root, __global FoldPlan* plans, __global uint* front,
                        __global WideNode* wide, __global uint* leaves, uint first_node, uint first_leaf,
                        uint step) {
  const uint i = (uint)get_global_id(0);
  if (step == 0u)
    emit_top(nodes, root, plans, front, wide, leaves, first_node, first_leaf);
  else if (i < subtrees_of(front))
    emit_subtree(nodes, subtree_root(front, i), plans, wide, leaves, first_node, first_leaf);
}
