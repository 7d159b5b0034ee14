#include "tracer/sort_tuning.hpp"

#include <algorithm>

namespace facet::tracer {

sort_tuning sort_tuning_for(const runtime::device& d) {
  sort_tuning t;
  t.tiles = 4 * d.max_compute_units();
  t.few = std::max(4096u, 131072 / d.max_compute_units());
  if (!d.is_gpu()) return t;
  t.face = sort_face::group;
  t.histogram_groups = 4 * d.max_compute_units();
  // match, votes, and loads that only order what they name are PTX of compute capability 7.0.
  if (d.nvidia_compute_capability() >= 70 && d.max_work_group_size() >= 512) {
    t.ranking = sort_ranking::ballot;
    // Measured on an H200 with 16 M keys. A tile of u32 must leave its keys below 32 KiB, or fewer
    // groups fit a multiprocessor; one of u64 pays for it by longer runs.
    t.group_32 = 384, t.items_32 = 20;
    t.group_64 = 512, t.items_64 = 11;
    t.histogram_copies = 2;
    t.registers = 128;  // a group of 512 fits
  }
  return t;
}

}  // namespace facet::tracer
