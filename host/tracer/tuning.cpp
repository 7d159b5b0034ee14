#include "tracer/tuning.hpp"

namespace facet::tracer {

std::string tuning::flags() const {
  std::string options = " -cl-std=CL1.2";
  if (correctly_rounded) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (hardware_minmax) options += " -DFACET_HARDWARE_MINMAX";
  if (!more_flags.empty()) options += " " + more_flags;
  return options;
}

tuning tuning_for(const runtime::device& d) {
  tuning t;
  t.correctly_rounded = d.has_correctly_rounded_divide_sqrt();
  if (d.is_gpu()) {
    t.hardware_minmax = true;
    t.sort_tiles = 1u << 14;
    t.sort_tile_least = 256;
  } else {
    // A few tiles for each core: PoCL runs a tile on one core from start to end.
    t.sort_tiles = 4 * d.max_compute_units();
    t.wide_layout = true;
  }
  return t;
}

}  // namespace facet::tracer
