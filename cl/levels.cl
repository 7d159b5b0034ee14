// The radix tree (radix_tree.h) over the subtrees' items and the places below them, merged bottom-up: what the source
// design did level by level. A group takes a subtree (cl/subtrees.cl), where it knows all levels at once; above
// them work-items climb, and of two that meet at a boundary the second goes on (Apetrei, "Fast and simple
// agglomerative LBVH construction", 2014), so that none waits.
#include "bounds.h"
#include "leaf_order.h"
#include "radix_tree.h"
#include "warp.h"

// Words of local memory, in the order in which they stand.
#define MERGE_BOX 0u        // [5][6][32] floats: bounds of 2^j places in a row, by j and the first of them
#define MERGE_COMMON 960u   // of each place and the next (radix_tree.h), of the subtree's inner boundaries
#define MERGE_PARENT 992u   // of the node that joins a place and the next, likewise a place
#define MERGE_CHILD 1024u   // [2][32]: its children
#define MERGE_LEAVES 1088u  // boundaries within leaves, as bits; then those of nodes
#define MERGE_HEIGHT 1090u
#define MERGE_BASE 1091u
#define MERGE_ROOT 1092u
// FACET_MERGE_WORDS in all

static inline Bounds run_bounds(__local const float* box, uint j, uint i) {
  __local const float* b = box + 192u * j + i;
  Bounds r;
  r.lo = (float3)(b[0], b[32], b[64]);
  r.hi = (float3)(b[96], b[128], b[160]);
  return r;
}

static inline void put_run(__local float* box, uint j, uint i, Bounds b) {
  __local float* to = box + 192u * j + i;
  to[0] = b.lo.x, to[32] = b.lo.y, to[64] = b.lo.z;
  to[96] = b.hi.x, to[128] = b.hi.y, to[160] = b.hi.z;
}

// Of places a to b: two runs that may overlap.
static inline Bounds range_bounds(__local const float* box, uint a, uint b) {
  const uint j = min(31u - clz(b - a + 1u), 4u);
  return joined(run_bounds(box, j, a), run_bounds(box, j, b + 1u - (1u << j)));
}

static inline void put_side(Node* n, uint side, Bounds b, uint child) {
  n->x[0][side] = b.lo.x, n->y[0][side] = b.lo.y, n->z[0][side] = b.lo.z;
  n->x[1][side] = b.hi.x, n->y[1][side] = b.hi.y, n->z[1][side] = b.hi.z;
  n->child[side] = child;
  n->spare[side] = 0u;
}

// As build_bottoms (cl/bottom.cl), but that the order stays; nodes stand in the order of their boundaries.
__kernel __attribute__((reqd_work_group_size(32, 1, 1))) void merge_subtrees(
    PRIMITIVES restrict primitives, __global const uint* codes, __global const uint* starts,
    __global const uint* order, __global Node* nodes, __global Item* items, __global uint* refs,
    volatile __global uint* counter, uint count, uint room LEAF_ORDER_ARGUMENTS, __local uint* pool) {
  __local float* box = (__local float*)pool;
  const uint lane = (uint)get_local_id(0), k = (uint)get_group_id(0);
  const uint first = starts[k], size = starts[k + 1u] - first;
  const bool is_boundary = lane + 1u < size;
  const uint primitive = lane < size ? order[first + lane] : 0u;
  put_run(box, 0u, lane, lane < size ? bounds_at(primitives, primitive) : no_bounds());
  pool[MERGE_COMMON + lane] = is_boundary ? common_bits(codes, count, first + lane) : 0u;
  if (lane < 2u) pool[MERGE_LEAVES + lane] = 0u;
  if (lane == 0u) pool[MERGE_HEIGHT] = 0u;
  if (lane < size) PUT_IN_ORDER(primitive, first + lane);
  for (uint j = 0u; j < 4u; ++j) {
    barrier(CLK_LOCAL_MEM_FENCE);
    put_run(box, j + 1u, lane, joined(run_bounds(box, j, lane), run_bounds(box, j, min(lane + (1u << j), 31u))));
  }
  barrier(CLK_LOCAL_MEM_FENCE);

  // The node that joins places lane and lane + 1 has places l to r.
  uint l = lane, r = lane;
  Node own;
  if (is_boundary) {
    const uint common = pool[MERGE_COMMON + lane];
    while (l > 0u && pool[MERGE_COMMON + l - 1u] > common) --l;
    do ++r; while (pool[MERGE_COMMON + r] > common);
    const Bounds left = range_bounds(box, l, lane), right = range_bounds(box, lane + 1u, r);
    const uint left_size = lane - l + 1u, right_size = r - lane, both = left_size + right_size;
    put_side(&own, 0u, left, FACET_LEAF(first + l, left_size));
    put_side(&own, 1u, right, FACET_LEAF(first + lane + 1u, right_size));
    const bool is_leaf = both <= LEAF_SURE ||
                         (both <= LEAF_MOST && !(half_area(joined(left, right)) * (float)(both - 1u) >
                                                 split_cost(left, (float)left_size, right, (float)right_size)));
    if (is_leaf) atomic_or(&pool[MERGE_LEAVES], ((1u << r) - 1u) & ~((1u << l) - 1u));
  }
  pool[MERGE_CHILD + lane] = pool[MERGE_CHILD + 32u + lane] = FACET_NONE;
  barrier(CLK_LOCAL_MEM_FENCE);
  const bool is_node = is_boundary && (pool[MERGE_LEAVES] >> lane & 1u) == 0u;
  uint parent = FACET_NONE;
  if (is_node) {
    atomic_or(&pool[MERGE_LEAVES + 1u], 1u << lane);
    const uint before = l > 0u ? pool[MERGE_COMMON + l - 1u] : 0u, after = pool[MERGE_COMMON + r];
    if (before != after) parent = after > before ? r : l - 1u;
    pool[MERGE_PARENT + lane] = parent;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint made = pool[MERGE_LEAVES + 1u];
  if (lane == 0u) pool[MERGE_BASE] = made == 0u ? 0u : atomic_add(counter, (uint)popcount(made));
  if (is_node) {
    uint height = 1u;
    for (uint above = parent; above != FACET_NONE; above = pool[MERGE_PARENT + above]) ++height;
    atomic_max(&pool[MERGE_HEIGHT], height);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint base = pool[MERGE_BASE], number = base + popcount(made & ((1u << lane) - 1u));
  if (is_node) {
    if (parent == FACET_NONE)
      pool[MERGE_ROOT] = number;
    else
      pool[MERGE_CHILD + (parent == r ? 0u : 32u) + parent] = number;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  // What does not fit is counted all the same: the host makes room and starts again.
  if (is_node && number < room) {
    for (uint side = 0u; side < 2u; ++side)
      if (pool[MERGE_CHILD + 32u * side + lane] != FACET_NONE) own.child[side] = pool[MERGE_CHILD + 32u * side + lane];
    nodes[number] = own;
  }
  if (lane == 0u) {
    const Bounds all = range_bounds(box, 0u, size - 1u);
    Item item;
    item.lo[0] = all.lo.x, item.lo[1] = all.lo.y, item.lo[2] = all.lo.z, item.index = k;
    item.hi[0] = all.hi.x, item.hi[1] = all.hi.y, item.hi[2] = all.hi.z;
    item.size = size | pool[MERGE_HEIGHT] << FACET_HEIGHT_BIT;
    items[k] = item;
    refs[k] = made == 0u ? FACET_LEAF(first, size) : pool[MERGE_ROOT];
  }
}

// What one that climbs leaves for the other: its side of the node where they meet. Its height, and from bit 8 on
// what its far end has in common with what comes next, wait in the side's spare word.
static inline void leave_side(__global Node* n, uint side, Bounds b, uint child, uint more) {
  share_word((__global uint*)&n->x[0][side], as_uint(b.lo.x));
  share_word((__global uint*)&n->x[1][side], as_uint(b.hi.x));
  share_word((__global uint*)&n->y[0][side], as_uint(b.lo.y));
  share_word((__global uint*)&n->y[1][side], as_uint(b.hi.y));
  share_word((__global uint*)&n->z[0][side], as_uint(b.lo.z));
  share_word((__global uint*)&n->z[1][side], as_uint(b.hi.z));
  share_word(&n->child[side], child);
  share_word(&n->spare[side], more);
}

static inline float shared_float(__global float* word) { return as_float(shared_word((__global uint*)word)); }

static inline Bounds left_bounds(__global Node* n, uint side) {
  Bounds b;
  b.lo = (float3)(shared_float(&n->x[0][side]), shared_float(&n->y[0][side]), shared_float(&n->z[0][side]));
  b.hi = (float3)(shared_float(&n->x[1][side]), shared_float(&n->y[1][side]), shared_float(&n->z[1][side]));
  return b;
}

// A work-item begins at each of `subtrees` > 1 items; nodes[i] joins item i and the next. ends[i], FACET_NONE at
// first: where the range ends that came first to that boundary. told[1]: the root; told[2]: nodes on the
// longest way down.
__kernel void merge_items(__global const uint* codes, __global const uint* starts, __global const Item* items,
                          __global const uint* refs, __global Node* nodes, volatile __global uint* ends,
                          __global uint* told, uint count, uint subtrees) {
  const uint k = (uint)get_global_id(0);
  if (k >= subtrees) return;
  Bounds own = item_bounds(&items[k]);
  uint child = refs[k], height = FACET_HEIGHT_OF(items[k].size), begin = k, end = k;
  uint before = common_bits(codes, count, starts[k] - 1u), after = common_bits(codes, count, starts[k + 1u] - 1u);
  while (before != after) {
    const uint side = after > before ? 0u : 1u, at = side == 0u ? end : begin - 1u;
    leave_side(&nodes[at], side, own, child, height | (side == 0u ? before : after) << 8);
    share_fence();
    const uint other = atomic_xchg(&ends[at], side == 0u ? begin : end);
    if (other == FACET_NONE) return;
    share_fence();
    const uint more = shared_word(&nodes[at].spare[1u - side]);
    own = joined(own, left_bounds(&nodes[at], 1u - side));
    height = 1u + max(height, more & 255u);
    if (side == 0u)
      end = other, after = more >> 8;
    else
      begin = other, before = more >> 8;
    share_word(&nodes[at].spare[0], 0u);
    share_word(&nodes[at].spare[1], 0u);
    child = at;
  }
  told[1] = child;
  told[2] = height;
}
