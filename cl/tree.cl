// From a builder's binary tree to what traversal reads.
#include "vec.h"

// Subtrees of at most leaf_size primitives become leaves: they cover consecutive primitives.
static inline uint child_of(__global const TreeNode* nodes, uint child, uint count, uint leaf_size,
                            uint node_offset, uint slot_offset) {
  const uint first = nodes[child].first, size = nodes[child].last - first + 1u;
  return size <= leaf_size ? FACET_LEAF(slot_offset + first, size) : node_offset + (child - count);
}

// Node count + i of the binary tree stands at node_offset + i. Nodes inside leaves are not written.
__kernel void make_nodes(__global const TreeNode* tree, __global Node* nodes, uint count,
                         uint leaf_size, uint node_offset, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i + 1u >= count) return;
  __global const TreeNode* n = &tree[count + i];
  if (n->last - n->first + 1u <= leaf_size) return;
  __global const TreeNode* l = &tree[n->left];
  __global const TreeNode* r = &tree[n->right];
  Node out;
  out.x[0] = l->lo[0], out.x[1] = r->lo[0], out.x[2] = l->hi[0], out.x[3] = r->hi[0];
  out.y[0] = l->lo[1], out.y[1] = r->lo[1], out.y[2] = l->hi[1], out.y[3] = r->hi[1];
  out.z[0] = l->lo[2], out.z[1] = r->lo[2], out.z[2] = l->hi[2], out.z[3] = r->hi[2];
  out.child[0] = child_of(tree, n->left, count, leaf_size, node_offset, slot_offset);
  out.child[1] = child_of(tree, n->right, count, leaf_size, node_offset, slot_offset);
  out.spare[0] = out.spare[1] = 0u;
  nodes[node_offset + i] = out;
}

// Puts three float4 a triangle, and what the triangle is, into leaf order; i counts from the
// mesh's first triangle.
__kernel void gather_triangles(__global const uint* order, __global const float4* corners,
                               __global const uint* materials, __global float4* corners_out,
                               __global TriangleInfo* infos, uint count, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint from = order[i];
  const size_t to = (size_t)slot_offset + i;
  for (size_t c = 0; c < 3; ++c) corners_out[3 * to + c] = corners[3 * (size_t)from + c];
  TriangleInfo info;
  info.triangle = from;
  info.material = materials[from];
  info.spare[0] = info.spare[1] = 0u;
  infos[to] = info;
}

__kernel void gather_normals(__global const uint* order, __global const float4* normals,
                             __global float4* normals_out, uint count, uint slot_offset) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const size_t to = (size_t)slot_offset + i;
  for (size_t c = 0; c < 3; ++c) normals_out[3 * to + c] = normals[3 * (size_t)order[i] + c];
}
