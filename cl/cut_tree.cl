// From a binary tree over single primitives (layout.h: TreeNode) to one whose leaves are runs of them: a
// subtree of no more than leaf_size primitives is a leaf.
#include "vec.h"

static inline uint size_of(__global const TreeNode* n) { return n->last - n->first + 1u; }

// numbers[i]: of the node that joins positions i and i + 1, if it stays one. A work-item numbers those of
// `run` positions in a row; in what order work-items come decides numbers, not trees.
__kernel void number_nodes(__global const TreeNode* tree, __global uint* numbers,
                           volatile __global uint* total, uint count, uint leaf_size, uint run) {
  const ulong first = get_global_id(0) * (ulong)run;
  const uint end = (uint)min(first + run, (ulong)count - 1ul);
  uint own = 0u;
  for (uint i = (uint)min(first, (ulong)end); i < end; ++i) {
    const uint stays = size_of(&tree[count + i]) > leaf_size;
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
