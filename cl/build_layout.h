// What builders of trees and layouts keep for themselves, and the sizes that kernels and host share.
#ifndef FACET_BUILD_LAYOUT_H
#define FACET_BUILD_LAYOUT_H

#include "structure.h"

#ifndef __OPENCL_C_VERSION__
namespace facet::tracer {
#endif

// A primitive's bounds, input of every builder.
struct FACET_ALIGNED Box {
  float lo[3];
  uint spare0;
  float hi[3];
  uint spare1;
};

// How centres of boxes, doubled (lo + hi), become codes along a Morton curve: bit k of an axis' cell
// goes to the k-th lowest bit of its mask.
struct FACET_ALIGNED Curve {
  float lo[3];  // of all centres
  uint spare0;
  float hi[3];
  uint spare1;
  float scale[3];  // cells a unit; 0 for an axis without extent
  uint spare2;
  uint mask[3];
  uint spare3;
};

// A finished subtree, as an input of the top tree's builder.
struct FACET_ALIGNED Item {
  float lo[3];
  uint index;  // along the curve; says what it is (refs[index], as a node's child) and breaks ties
  float hi[3];
  uint size;  // primitives below, and from bit FACET_HEIGHT_BIT on the height in nodes
};
#define FACET_HEIGHT_BIT 16u
#define FACET_SIZE_OF(size) ((size) & 0xffffu)
#define FACET_HEIGHT_OF(size) ((size) >> FACET_HEIGHT_BIT)

// A node of the top tree that is not split yet: items begin to end - 1. Its nodes are to stand at
// `node` and the end - begin - 2 places after it.
struct FACET_ALIGNED TopRange {
  uint begin, end;
  uint node;
  uint depth;  // nodes above it
  float lo[3];
  uint first;  // no item's index is lower, ...
  float hi[3];  // lo to hi: where bins lie for doubled centres
  uint last;    // ... or higher
  uint buffer;  // which of two its items are in
  uint spare[3];
};

// The two sides of a range that is split, [side]: bounds as order-preserving integers (cl/bins.h), and
// how many items.
struct FACET_ALIGNED TopSides {
  uint lo[2][3], hi[2][3];
  uint count[2];
  uint spare[2];
};

// A node of the builders' binary tree. Nodes 0 to n-1 are the leaves in sorted order; n+i is the
// node that joins the sorted primitives i and i+1. It covers the sorted range first..last.
struct FACET_ALIGNED TreeNode {
  float lo[3];
  uint left;   // child; a leaf: the primitive
  float hi[3];
  uint right;  // child; a leaf: FACET_NONE
  uint first, last;
  uint height;  // 0 for a leaf, else 1 + the larger of the children's
  uint spare;
};

// Boxes that a group of as many work-items builds a tree over (cl/sweep.h), and words of local memory that it
// takes.
#define FACET_SWEEP_MOST 32u
#define FACET_SWEEP_WORDS 788u
// Words of local memory that a group takes to merge a subtree (cl/levels.cl).
#define FACET_MERGE_WORDS 1093u

// Of the top tree's builder (cl/top.cl, cl/bin_split.h): work-items of a group and items of a tile; words of a
// range's bins, and of local memory that a split takes; words of a level's counters, and where those of the
// whole tree begin.
#define FACET_TOP_GROUP 256u
#define FACET_TILE_ITEMS 1024u
#define FACET_BINS 16u
#define FACET_BIN_WORDS 8u
#define FACET_ALL_BIN_WORDS (3u * FACET_BINS * FACET_BIN_WORDS)
#define FACET_SPLIT_WORDS (FACET_ALL_BIN_WORDS + 3u * FACET_BINS + 4u + 16u)
#define FACET_LEVEL_WORDS 2u
#define FACET_TOTALS 512u

// What a subtree of the binary tree costs where it has k places among the children of a wide node, at
// [k - 1]: its wide nodes, as they were then chosen (cl/fold.h).
struct FACET_ALIGNED FoldCost {
  float area[8];  // sum of half their areas
  uint nodes[8];  // how many
  uint depth[8];  // how many on the longest way down
};

// What was chosen for a node of the binary tree. Its counts give way to its place once this is known.
struct FACET_ALIGNED FoldPlan {
  uint left;    // places that its left side takes, four bits for each k (cl/fold.h)
  uint leaves;  // of its subtree; then those before its own
  uint nodes;   // wide nodes of its subtree, where it is one itself; then those before it
  uint next;    // of a list threaded through the nodes
};

// How keys are cut into buckets (cl/bucket_plan.h).
struct FACET_ALIGNED BucketPlan {
  uint least_low, least_high;  // the key that bucket 0 begins at, 32 bits each
  uint shift;                  // a bucket takes 2^shift keys that follow each other
  uint buckets;                // at most 2048
  uint is_used;                // 0: the keys would not spread, and are sorted without buckets
  uint next;                   // the bucket that the next free work-item takes
  uint spare[2];
};

#ifdef __OPENCL_C_VERSION__
typedef struct Box Box;
typedef struct Curve Curve;
typedef struct Item Item;
typedef struct TopRange TopRange;
typedef struct TopSides TopSides;
typedef struct TreeNode TreeNode;
typedef struct FoldCost FoldCost;
typedef struct FoldPlan FoldPlan;
typedef struct BucketPlan BucketPlan;
#endif

FACET_SIZE(Box, 32)
FACET_SIZE(Curve, 64)
FACET_SIZE(Item, 32)
FACET_SIZE(TopRange, 64)
FACET_SIZE(TopSides, 64)
FACET_SIZE(TreeNode, 48)
FACET_SIZE(FoldCost, 96)
FACET_SIZE(FoldPlan, 16)
FACET_SIZE(BucketPlan, 32)

#ifndef __OPENCL_C_VERSION__
}  // namespace facet::tracer
#endif
#endif
