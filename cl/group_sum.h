// Running sums over a work-group.
#ifndef FACET_GROUP_SUM_H
#define FACET_GROUP_SUM_H

// The sum of what the work-items before this one give; the group's size is a power of two. sums: a word an
// item, which then hold the sums with the items' own. All work-items call it together, and a barrier must
// stand between two calls.
static inline uint sum_before(uint own, __local uint* sums) {
  const uint lid = (uint)get_local_id(0), size = (uint)get_local_size(0);
  sums[lid] = own;
  for (uint step = 1u; step < size; step *= 2u) {
    barrier(CLK_LOCAL_MEM_FENCE);
    const uint more = lid >= step ? sums[lid - step] : 0u;
    barrier(CLK_LOCAL_MEM_FENCE);
    sums[lid] += more;
  }
  barrier(CLK_LOCAL_MEM_FENCE);
  return sums[lid] - own;
}

#endif
