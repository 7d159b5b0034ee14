// Whether look-back works on a device: asked with a bound, so that it can fail and not hang.
#include "look_back.h"

// What group g has to add in column c; host/tracer/look_back.cpp has it too.
static inline uint own_count(uint group, uint column) { return (group * 7u + column * 13u) % 31u; }

// sums[g * columns + c]: what look-back finds before group g, a column a work-item. words, counter and
// failed are 0 before. FACET_LOOK_BACK_REVERSED hands ids out last first: that must fail.
__kernel void prove_look_back(__global uint* words, __global uint* counter, __global uint* failed,
                              __global uint* sums, uint steps) {
  __local uint handed[1];
  if (get_local_id(0) == 0) handed[0] = atomic_inc((volatile __global uint*)counter);
  barrier(CLK_LOCAL_MEM_FENCE);
#ifdef FACET_LOOK_BACK_REVERSED
  const uint group = (uint)get_num_groups(0) - 1u - handed[0];
#else
  const uint group = handed[0];
#endif
  const uint columns = (uint)get_local_size(0), column = (uint)get_local_id(0);
  const uint own = own_count(group, column);
  __global uint* word = &words[group * columns + column];
  uint before = 0u;
  if (group > 0u) {
    share_word(word, own | COUNT_OF_ONE);
    // One that gave up ends the others' wait.
    const bool is_lost = atomic_or((volatile __global uint*)failed, 0u) != 0u;
    before = is_lost ? LOOK_BACK_FAILED : look_back(words + column, group, columns, steps);
    if (before == LOOK_BACK_FAILED) {
      atomic_or((volatile __global uint*)failed, 1u);
      before = 0u;
    }
  }
  share_word(word, (before + own & COUNT_BITS) | COUNT_OF_ALL);
  sums[group * columns + column] = before;
}
