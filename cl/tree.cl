// Trees of several meshes in one array.
#include "layout.h"

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
