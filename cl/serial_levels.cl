// The trees of cl/levels.cl, a work-item to each run of them: for devices whose work-items are the cores of a CPU.
//
// A subtree of the radix tree (radix_tree.h) is joined with the next one where they have more in common than
// with those beside them. So one walk along the places, with a stack of what is not yet joined, finds all joins.
#include "packed.h"
#include "radix_tree.h"

typedef struct {
  Packed box;
  uint first;   // place, or item
  uint before;  // what it has in common with what comes before it
  uint child;   // as a node's
  uint height;
  uint made;  // nodes that there were before its own
} Subtree;

// Whether the last two on a stack are joined before what follows, with which they have `after` in common.
static inline bool are_joined(const Subtree* stack, uint top, uint after) {
  return top > 1u && stack[top - 1u].before > stack[top - 2u].before && stack[top - 1u].before > after;
}

static inline Node node_of(const Subtree* l, const Subtree* r) {
  Node n;
  put_packed(&n, 0u, l->box);
  put_packed(&n, 1u, r->box);
  n.child[0] = l->child, n.child[1] = r->child;
  n.spare[0] = n.spare[1] = 0u;
  return n;
}

static inline void join_last(Subtree* stack, uint* top, uint child) {
  Subtree* l = &stack[*top - 2u];
  const Subtree* r = &stack[*top - 1u];
  l->box = joined_packed(l->box, r->box);
  l->height = 1u + max(l->height, r->height);
  l->child = child;
  --*top;
}

// Whether a subtree of the places from `first` to `end` - 1 is a leaf.
static inline bool is_leaf(const Subtree* l, const Subtree* r, uint end) {
  const uint size = end - l->first, left = r->first - l->first;
  if (size <= LEAF_SURE || size > LEAF_MOST) return size <= LEAF_SURE;
  return !(packed_area(joined_packed(l->box, r->box)) * (float)(size - 1u) >
           packed_cost(l->box, (float)left, r->box, (float)(size - left)));
}

// As merge_subtrees of cl/levels.cl, `each` subtrees a work-item.
__kernel void merge_subtrees(PRIMITIVES restrict primitives, __global const uint* codes, __global const uint* starts,
                             __global const uint* order, __global Node* nodes, __global Item* items,
                             __global uint* refs, volatile __global uint* counter, uint count, uint room,
                             uint subtrees, uint each) {
  const uint begin = (uint)get_global_id(0) * each, end = min(begin + each, subtrees);
  for (uint k = begin; k < end; ++k) {
    const uint first = starts[k], next = starts[k + 1u];
    Subtree stack[FACET_SWEEP_MOST];
    Node made[FACET_SWEEP_MOST];
    uint top = 0u, made_count = 0u, before = 0u;
    Packed all = no_packed();
    for (uint i = first; i < next; ++i) {
      if (i + PRIMITIVES_AHEAD < count) fetch_primitive(primitives, order[i + PRIMITIVES_AHEAD]);
      Subtree* pushed = &stack[top++];
      pushed->box = packed(bounds_at(primitives, order[i]));
      pushed->first = i, pushed->before = before, pushed->made = made_count;
      pushed->child = FACET_LEAF(i, 1u), pushed->height = 0u;
      all = joined_packed(pushed->box, all);
      before = i + 1u < next ? common_bits(codes, count, i) : 0u;
      while (are_joined(stack, top, before)) {
        Subtree* l = &stack[top - 2u];
        if (is_leaf(l, l + 1, i + 1u)) {
          made_count = l->made;  // none of those below it
          join_last(stack, &top, FACET_LEAF(l->first, i + 1u - l->first));
          l->height = 0u;
        } else {
          made[made_count] = node_of(l, l + 1);
          join_last(stack, &top, made_count++);
        }
      }
    }
    // What does not fit is counted all the same: the host makes room and starts again.
    const uint base = made_count == 0u ? 0u : atomic_add(counter, made_count);
    if (base + made_count <= room)
      for (uint i = 0u; i < made_count; ++i) {
        for (uint side = 0u; side < 2u; ++side)
          if (!(made[i].child[side] & FACET_LEAF_BIT)) made[i].child[side] += base;
        nodes[base + i] = made[i];
      }
    Item item;
    item.lo[0] = all.s0, item.lo[1] = all.s1, item.lo[2] = all.s2, item.index = k;
    item.hi[0] = -all.s4, item.hi[1] = -all.s5, item.hi[2] = -all.s6;
    item.size = next - first | stack[0].height << FACET_HEIGHT_BIT;
    items[k] = item;
    refs[k] = made_count == 0u ? stack[0].child : stack[0].child + base;
  }
}

// Subtrees of items that wait for each other: what they have in common falls from one to the next, and
// then grows.
#define MOST_LOOSE 132u

static inline uint common_before(__global const uint* codes, __global const uint* starts, uint count, uint item) {
  return common_bits(codes, count, starts[item] - 1u);
}

// Joins items[begin] to items[end - 1], which come after those on the stack; `after` is what the last one has in
// common with the next.
static inline void merge_run(__global const uint* codes, __global const uint* starts, __global const Item* items,
                             __global const uint* refs, __global Node* nodes, uint count, uint begin, uint end,
                             uint after, Subtree* stack, uint* top) {
  for (uint i = begin; i < end; ++i) {
    Subtree* pushed = &stack[(*top)++];
    pushed->box = packed(item_bounds(&items[i]));
    pushed->first = items[i].index;
    pushed->before = common_before(codes, starts, count, items[i].index);
    pushed->child = refs[i], pushed->height = FACET_HEIGHT_OF(items[i].size);
    const uint next = i + 1u < end ? common_before(codes, starts, count, items[i + 1u].index) : after;
    while (are_joined(stack, *top, next)) {
      const Subtree* r = &stack[*top - 1u];
      const uint at = r->first - 1u;
      nodes[at] = node_of(r - 1, r);
      join_last(stack, top, at);
    }
  }
}

// nodes[i] joins item i and the next. Each work-item joins what it can of `each` items, and leaves the others where
// these begin: loose[run] of them, whose `index` is the first item that they were made of.
__kernel void merge_runs(__global const uint* codes, __global const uint* starts, __global Item* items,
                         __global uint* refs, __global Node* nodes, __global uint* loose, uint count,
                         uint subtrees, uint each) {
  const uint run = (uint)get_global_id(0), begin = run * each, end = min(begin + each, subtrees);
  Subtree stack[MOST_LOOSE];
  uint top = 0u;
  const uint after = end < subtrees ? common_before(codes, starts, count, end) : 0u;
  merge_run(codes, starts, items, refs, nodes, count, begin, end, after, stack, &top);
  for (uint i = 0u; i < top; ++i) {
    const Subtree* s = &stack[i];
    Item item;
    item.lo[0] = s->box.s0, item.lo[1] = s->box.s1, item.lo[2] = s->box.s2, item.index = s->first;
    item.hi[0] = -s->box.s4, item.hi[1] = -s->box.s5, item.hi[2] = -s->box.s6;
    item.size = s->height << FACET_HEIGHT_BIT;
    items[begin + i] = item;
    refs[begin + i] = s->child;
  }
  loose[run] = top;
}

// Joins what the runs have left. told[1]: the root; told[2]: nodes on the longest way down.
__kernel void merge_loose(__global const uint* codes, __global const uint* starts, __global const Item* items,
                          __global const uint* refs, __global Node* nodes, __global const uint* loose,
                          __global uint* told, uint count, uint subtrees, uint each) {
  Subtree stack[MOST_LOOSE];
  uint top = 0u;
  for (uint run = 0u, begin = 0u; begin < subtrees; ++run, begin += each) {
    const uint next = begin + each;
    merge_run(codes, starts, items, refs, nodes, count, begin, begin + loose[run],
              next < subtrees ? common_before(codes, starts, count, items[next].index) : 0u, stack, &top);
  }
  told[1] = stack[0].child;
  told[2] = stack[0].height;
}
