// A binary tree over sorted Morton codes, merged bottom-up, level by level.
//
// Neighbours i and i+1 in sorted order first differ at some bit of (code, position): that
// bit is the level of the boundary between them, and all that shares the bits above is joined there.
// Within a level each boundary has a different prefix above it, so its two sides are whole
// subtrees of lower levels and no two merges touch. Positions break ties of equal codes, so the
// depth is at most 32 + ceil(log2 n), also where all codes are equal. The tree is that of
// Karras (HPG 2012), in the order of the source design.
#include "bounds.h"

// The boxes of triangles, three corners in a row.
__kernel void triangle_boxes(__global const float4* corners, __global Box* boxes, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const Bounds b = bounds_at(corners, i);
  Box box;
  box.lo[0] = b.lo.x, box.lo[1] = b.lo.y, box.lo[2] = b.lo.z, box.spare0 = 0u;
  box.hi[0] = b.hi.x, box.hi[1] = b.hi.y, box.hi[2] = b.hi.z, box.spare1 = 0u;
  boxes[i] = box;
}

// 1 to 28: the codes are equal and the positions differ; 32 + bit of the code, otherwise.
__kernel void boundary_levels(__global const uint* codes, __global uint* levels,
                              __global uint* boundaries, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i + 1u >= count) return;
  const uint difference = codes[i] ^ codes[i + 1u];
  levels[i] = difference == 0u ? 32u - clz(i ^ (i + 1u)) : 64u - clz(difference);
  boundaries[i] = i;
}

// starts[l]: where level l starts among the sorted levels; the host has set all to `boundaries`.
__kernel void level_starts(__global const uint* levels, __global uint* starts, uint boundaries) {
  const uint i = (uint)get_global_id(0);
  if (i >= boundaries) return;
  if (i == 0u || levels[i - 1u] != levels[i]) starts[levels[i]] = i;
}

// Leaf i is the primitive order[i]. ends[i] and begins[i] name the subtree that ends, or begins, at
// the sorted position i.
__kernel void make_leaves(__global const Box* boxes, __global const uint* order,
                          __global TreeNode* nodes, __global uint* begins, __global uint* ends,
                          uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  __global const Box* box = &boxes[order[i]];
  TreeNode n;
  for (int c = 0; c < 3; ++c) {
    n.lo[c] = box->lo[c];
    n.hi[c] = box->hi[c];
  }
  n.left = order[i];
  n.right = FACET_NONE;
  n.first = n.last = i;
  n.height = 0u;
  n.spare = 0u;
  nodes[i] = n;
  begins[i] = ends[i] = i;
}

// Joins the subtrees on both sides of the boundaries of one level.
__kernel void merge_level(__global const uint* boundaries, __global TreeNode* nodes,
                          __global uint* begins, __global uint* ends, uint count, uint level_start,
                          uint level_size) {
  const uint k = (uint)get_global_id(0);
  if (k >= level_size) return;
  const uint i = boundaries[level_start + k];
  const uint left = ends[i], right = begins[i + 1u], id = count + i;
  __global const TreeNode* l = &nodes[left];
  __global const TreeNode* r = &nodes[right];
  TreeNode n;
  for (int c = 0; c < 3; ++c) {
    n.lo[c] = smaller(l->lo[c], r->lo[c]);
    n.hi[c] = larger(l->hi[c], r->hi[c]);
  }
  n.left = left;
  n.right = right;
  n.first = l->first;
  n.last = r->last;
  n.height = 1u + max(l->height, r->height);
  n.spare = 0u;
  nodes[id] = n;
  begins[n.first] = id;
  ends[n.last] = id;
}

// What the host wants to know of the finished tree: the root and its height.
__kernel void tree_root(__global const uint* begins, __global const TreeNode* nodes,
                        __global uint* root) {
  root[0] = begins[0];
  root[1] = nodes[begins[0]].height;
}
