// From a builder's binary tree to what traversal reads.
#include "bounds.h"

static inline uint size_of(__global const TreeNode* n) { return n->last - n->first + 1u; }

static inline float tree_node_area(__global const TreeNode* n) {
  Bounds b;
  b.lo = vec_global(n->lo);
  b.hi = vec_global(n->hi);
  return half_area(b);
}

// Whether a subtree becomes a leaf: at most leaf_size primitives (they are consecutive), where testing all
// of them costs no more than visiting its children, by the surface area heuristic (MacDonald and
// Booth 1990). A visit counts as much as NODE_COST tests.
#define NODE_COST 1.0f
static inline bool is_leaf(__global const TreeNode* tree, uint node, uint leaf_size) {
  __global const TreeNode* n = &tree[node];
  const uint size = size_of(n);
  if (size == 1u || size > leaf_size) return size == 1u;
  __global const TreeNode* l = &tree[n->left];
  __global const TreeNode* r = &tree[n->right];
  return tree_node_area(n) * ((float)size - NODE_COST) <=
         tree_node_area(l) * (float)size_of(l) + tree_node_area(r) * (float)size_of(r);
}

// Node count + i of the binary tree stands at node_offset + i, as if a ray could come there. Only the
// nodes that the root leads to are ever read.
__kernel void make_nodes(__global const TreeNode* tree, __global Node* nodes, uint count,
                         uint leaf_size, uint node_offset, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i + 1u >= count) return;
  const uint child[2] = {tree[count + i].left, tree[count + i].right};
  Node out;
  for (uint c = 0u; c < 2u; ++c) {
    __global const TreeNode* n = &tree[child[c]];
    out.x[0][c] = n->lo[0], out.x[1][c] = n->hi[0];
    out.y[0][c] = n->lo[1], out.y[1][c] = n->hi[1];
    out.z[0][c] = n->lo[2], out.z[1][c] = n->hi[2];
    out.child[c] = is_leaf(tree, child[c], leaf_size) ? FACET_LEAF(slot_offset + n->first, size_of(n))
                                                      : node_offset + (child[c] - count);
    out.spare[c] = 0u;
  }
  nodes[node_offset + i] = out;
}

// Does nothing with a buffer but to need it.
__kernel void touch(__global const uint* words) {}

// Puts a tree's nodes behind others: its children's indices and places are then those of all.
__kernel void append_nodes(__global const Node* from, __global Node* to, uint count, uint node_offset,
                           uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  Node n = from[i];
  for (uint c = 0u; c < 2u; ++c)
    n.child[c] += (n.child[c] & FACET_LEAF_BIT) != 0u ? slot_offset : node_offset;
  to[node_offset + i] = n;
}
