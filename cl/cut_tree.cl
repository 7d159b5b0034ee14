// From a binary tree over single primitives (layout.h: TreeNode) to one whose leaves are runs of them.
#include "bounds.h"

static inline uint size_of(__global const TreeNode* n) { return n->last - n->first + 1u; }

static inline float area_of(__global const TreeNode* n) {
  Bounds b;
  b.lo = vec_global(n->lo);
  b.hi = vec_global(n->hi);
  return half_area(b);
}

// Whether a subtree is no leaf (host/tracer/leaf_rule.hpp).
static inline bool stays_node(__global const TreeNode* tree, __global const TreeNode* n, uint sure, uint most) {
  const uint size = size_of(n);
  if (size <= sure || size > most) return size > most;
  __global const TreeNode* l = &tree[n->left];
  __global const TreeNode* r = &tree[n->right];
  return area_of(n) * (float)(size - 1u) > area_of(l) * (float)size_of(l) + area_of(r) * (float)size_of(r);
}

// numbers[i]: of the node that joins positions i and i + 1, if it stays one. A work-item numbers those of
// `run` positions in a row; in what order work-items come decides numbers, not trees.
__kernel void number_nodes(__global const TreeNode* tree, __global uint* numbers,
                           volatile __global uint* total, uint count, uint sure, uint most,
                           uint run) {
  const ulong first = get_global_id(0) * (ulong)run;
  const uint end = (uint)min(first + run, (ulong)count - 1ul);
  uint own = 0u;
  for (uint i = (uint)min(first, (ulong)end); i < end; ++i) {
    const uint stays = stays_node(tree, &tree[count + i], sure, most);
    numbers[i] = stays ? own : FACET_NONE;
    own += stays;
  }
  if (own == 0u) return;
  const uint before = atomic_add(total, own);
  for (uint i = (uint)first; i < end; ++i)
    if (numbers[i] != FACET_NONE) numbers[i] += before;
}

__kernel void cut_nodes(__global const TreeNode* tree, __global const uint* numbers, __global Node* nodes,
                        uint count) {
  const uint i = (uint)get_global_id(0);
  if (i + 1u >= count || numbers[i] == FACET_NONE) return;
  const uint child[2] = {tree[count + i].left, tree[count + i].right};
  Node out;
  for (uint c = 0u; c < 2u; ++c) {
    __global const TreeNode* n = &tree[child[c]];
    out.x[0][c] = n->lo[0], out.x[1][c] = n->hi[0];
    out.y[0][c] = n->lo[1], out.y[1][c] = n->hi[1];
    out.z[0][c] = n->lo[2], out.z[1][c] = n->hi[2];
    const uint number = child[c] < count ? FACET_NONE : numbers[child[c] - count];
    out.child[c] = number == FACET_NONE ? FACET_LEAF(n->first, size_of(n)) : number;
    out.spare[c] = 0u;
  }
  nodes[numbers[i]] = out;
}
