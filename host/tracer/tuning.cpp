#include "tracer/tuning.hpp"

namespace facet::tracer {

std::string tuning::flags() const { return hardware_minmax ? " -DFACET_HARDWARE_MINMAX" : ""; }

tuning tuning_for(const runtime::device& d) {
  tuning t;
  if (d.is_gpu()) {
    t.hardware_minmax = true;
    t.sort_tiles = 1u << 14;
    t.sort_tile_least = 256;
  } else {
    // A few tiles for each core: PoCL runs a tile on one core from start to end.
    t.sort_tiles = 4 * d.max_compute_units();
  }
  return t;
}

}  // namespace facet::tracer
