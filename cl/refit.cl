// Boxes of a tree whose triangles have moved, made anew: each child's box is that of what lies below it, no
// larger. The tree stays as it was built, and so does the way to each leaf.
//
// Nodes are shared out as treelets, in phases (host/tracer/refit_order.hpp): a work-item makes a treelet's
// boxes from its leaves up, and what it reads beside them is of phases before, which are launches before. So
// no work-item waits for another, and none depends on what another's stores look like while both run.
#include "bounds.h"
#include "geometry.h"

#ifdef FACET_WIDE

#define LEAF_TEXELS 18u  // a block

// Lanes without a triangle repeat corners of the block's first (blocks.h).
static inline Bounds leaf_bounds(GEOMETRY corners, uint leaf) {
  Points lo, hi;
  bounds_of(triangles_from(corners, FACET_LEAF_FIRST(leaf)), &lo, &hi);
  Bounds b;
  b.lo = (float3)(least_of(lo.x), least_of(lo.y), least_of(lo.z));
  b.hi = (float3)(most_of(hi.x), most_of(hi.y), most_of(hi.z));
  return b;
}

// Absent children have empty boxes.
static inline Bounds node_bounds(__global const SceneNode* n) {
  Bounds b;
  b.lo = (float3)(least_of(vload8(0, n->x[0])), least_of(vload8(0, n->y[0])), least_of(vload8(0, n->z[0])));
  b.hi = (float3)(most_of(vload8(0, n->x[1])), most_of(vload8(0, n->y[1])), most_of(vload8(0, n->z[1])));
  return b;
}

#else

#define LEAF_TEXELS 3u  // a slot

static inline Bounds leaf_bounds(GEOMETRY corners, uint leaf) {
  const uint first = FACET_LEAF_FIRST(leaf), count = FACET_LEAF_COUNT(leaf);
  Bounds b = bounds_at(corners, first);
  for (uint i = 1u; i < count; ++i) b = joined(b, bounds_at(corners, first + i));
  return b;
}

static inline Bounds node_bounds(__global const SceneNode* n) {
  return joined(side_bounds(n, 0u), side_bounds(n, 1u));
}

#endif

#define CHILDREN ((uint)(sizeof(((SceneNode*)0)->child) / sizeof(uint)))

// What the host orders treelets by: the children of the nodes first to first + count - 1.
__kernel void list_children(__global const SceneNode* nodes, __global uint* children, uint first, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  for (uint c = 0u; c < CHILDREN; ++c) children[(size_t)CHILDREN * i + c] = nodes[first + i].child[c];
}

static inline void refit_node(__global SceneNode* nodes, uint node, GEOMETRY corners) {
  __global SceneNode* n = &nodes[node];
  for (uint c = 0u; c < CHILDREN; ++c) {
    const uint child = n->child[c];
    if (child == FACET_NONE) continue;
    const Bounds b = child & FACET_LEAF_BIT ? leaf_bounds(corners, child) : node_bounds(&nodes[child]);
    n->x[0][c] = b.lo.x, n->x[1][c] = b.hi.x;
    n->y[0][c] = b.lo.y, n->y[1][c] = b.hi.y;
    n->z[0][c] = b.lo.z, n->z[1][c] = b.hi.z;
  }
}

// Asks for what refit_node will read of a node that has come: triangles, which no other node reads.
static inline void fetch_leaves(__global const SceneNode* n, GEOMETRY corners) {
  for (uint c = 0u; c < CHILDREN; ++c) {
    const uint child = n->child[c];
    if (child & FACET_LEAF_BIT && child != FACET_NONE)
      fetch_lines(corners + LEAF_TEXELS * (size_t)FACET_LEAF_FIRST(child), 256u);
  }
}

// Treelets first_treelet to first_treelet + count - 1, which are of one phase. order: the mesh's nodes, counted
// from first_node on, treelet by treelet; starts[i]: where treelet i starts in it.
__kernel void refit_treelets(__global SceneNode* nodes, __global const uint* order, __global const uint* starts,
                             GEOMETRY corners, uint first_node, uint first_treelet, uint count) {
  const uint i = (uint)get_global_id(0);
  if (i >= count) return;
  const uint end = starts[first_treelet + i + 1u];
  for (uint k = starts[first_treelet + i]; k < end; ++k) {
    if (k + 4u < end) fetch_lines(&nodes[first_node + order[k + 4u]], sizeof(SceneNode));
    if (k + 2u < end) fetch_leaves(&nodes[first_node + order[k + 2u]], corners);
    refit_node(nodes, first_node + order[k], corners);
  }
}
