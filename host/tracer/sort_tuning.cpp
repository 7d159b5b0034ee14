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
    // Measured on an H100 with 16 M keys. The longer a digit's runs the better, until a work-item
    // needs so many registers that only one group fits a multiprocessor. Words are asked for one
    // by one: more, at once, cost more of the memory's time than they save.
    t.group_32 = 512, t.items_32 = 15;
    t.group_64 = 384, t.items_64 = 15;
    t.window = 1;
    // In one launch a tile ends with a fence, which costs many keys more than a few launches do,
    // and 64-bit keys less than their eight.
    t.whole_most_32 = 1u << 23, t.whole_most_64 = t.any_count;
    t.histogram_groups = 2 * d.max_compute_units();
    t.histogram_copies = 2;
    t.registers = 128;  // a group of 512 fits
  }
  return t;
}

}  // namespace facet::tracer
