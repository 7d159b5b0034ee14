#include "tracer/sort_tuning.hpp"

namespace facet::tracer {

sort_tuning sort_tuning_for(const runtime::device& d) {
  sort_tuning t;
  t.tiles = 4 * d.max_compute_units();
  if (!d.is_gpu()) return t;
  t.face = sort_face::group;
  t.histogram_groups = 4 * d.max_compute_units();
  // match, votes, and loads that only order what they name are PTX of compute capability 7.0.
  if (d.nvidia_compute_capability() >= 70 && d.max_work_group_size() >= 384) {
    t.ranking = sort_ranking::ballot;
    t.group = 384;
    t.items_32 = 20;
    t.items_64 = 12;
    t.histogram_copies = 2;
    t.registers = 80;  // two groups fit a multiprocessor
  }
  return t;
}

}  // namespace facet::tracer
