// What a device's arithmetic and memory do at their best: the rates that tracing is held against.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/queue.hpp"

namespace facet::bench {

struct gather_rate {
  std::uint64_t bytes;  ///< of the nodes that are read from
  double nodes_per_s;   ///< of 64 bytes, each at a place of its own
};

struct chip_rates {
  double operations_per_s;  ///< fused multiply-adds of floats, of all work-items together
  std::vector<gather_rate> gathers;
};

/// Sizes of memory that nodes are read from: within a core's cache on a GPU, within the cache that
/// cores share, and beyond both.
inline constexpr std::uint64_t gather_bytes[] = {64u << 10, 16u << 20, 1u << 30};

/// By the device's events, the fastest of `repeats` launches after one to warm up. Sizes that the
/// device does not allow for one buffer are left out. Throws runtime::exception.
chip_rates measure_chip(runtime::queue queue, unsigned repeats);

}  // namespace facet::bench
