// The trees at the bottom: over each of the subtrees that cl/subtrees.cl lists, a group to a subtree.
#include "leaf_order.h"
#include "sweep.h"

// order: sorted place -> primitive; becomes leaf place -> primitive. Nodes are appended at counter[0];
// a leaf's places are counted from 0. refs[k]: what subtree k is as a node's child.
__kernel __attribute__((reqd_work_group_size(32, 1, 1))) void build_bottoms(
    PRIMITIVES restrict primitives, __global const uint* starts, __global uint* order, __global Node* nodes,
    __global Item* items, __global uint* refs, __global uint* counter, uint room LEAF_ORDER_ARGUMENTS, __local uint* pool) {
  const uint lane = (uint)get_local_id(0), k = (uint)get_group_id(0);
  const uint first = starts[k], count = starts[k + 1u] - first;
  const bool is_there = lane < count;
  __local float* box = (__local float*)pool;
  const uint primitive = is_there ? order[first + lane] : 0u;
  put_sweep_box(box, lane, bounds_at(primitives, primitive));
  pool[SWEEP_WEIGHT + lane] = 0u;
  const Swept t = sweep_tree(lane, count, 0u, pool);

  barrier(CLK_LOCAL_MEM_FENCE);
  pool[SWEEP_WEIGHT + lane] = primitive;
  if (lane == 0u) {
    pool[SWEEP_MASK] = t.nodes == 0u ? 0u : atomic_add(counter, t.nodes);
    pool[SWEEP_MASK + 1u] = 0u;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  const uint base = pool[SWEEP_MASK];
  const uint leaf = FACET_LEAF(first + t.leaf_begin, t.leaf_count);
  if (is_there) {
    const uint here = pool[SWEEP_WEIGHT + t.moved_from];
    order[first + lane] = here;
    PUT_IN_ORDER(here, first + lane);
    if (t.link != NO_LINK && lane == t.leaf_begin)
      pool[SWEEP_NODES + 16u * (t.link >> 1) + NODE_CHILD + (t.link & 1u)] = leaf;
    atomic_max(&pool[SWEEP_MASK + 1u], t.depth);
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  // What does not fit is counted all the same: the host makes room and starts again.
  if (base + t.nodes <= room)
    for (uint i = lane; i < 16u * t.nodes; i += 32u) {
      const uint word = i % 16u, value = pool[SWEEP_NODES + i];
      const bool is_node = word >= NODE_CHILD && (value & FACET_LEAF_BIT) == 0u;
      ((__global uint*)(nodes + base))[i] = word >= NODE_CHILD + 2u ? 0u : is_node ? value + base : value;
    }
  if (lane == 0u) {
    Bounds all = sweep_box(box, 0u);
    for (uint i = 1u; i < count; ++i) all = joined(all, sweep_box(box, i));
    Item item;
    item.lo[0] = all.lo.x, item.lo[1] = all.lo.y, item.lo[2] = all.lo.z, item.index = k;
    item.hi[0] = all.hi.x, item.hi[1] = all.hi.y, item.hi[2] = all.hi.z;
    item.size = count | pool[SWEEP_MASK + 1u] << FACET_HEIGHT_BIT;
    items[k] = item;
    refs[k] = t.nodes == 0u ? FACET_LEAF(first, count) : base;
  }
}
