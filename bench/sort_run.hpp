// One figure of the row `sort`: a device's radix sort, TBB and std::sort on the same random keys.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/tuning.hpp"

namespace facet::bench {

struct sort_plan {
  tracer::tuning tuned;
  std::uint32_t count = 0;
  unsigned bits = 32;     ///< of the keys that are sorted by
  bool is_order = false;  ///< values start as 0, 1, 2, ... and are not read
  int repeats = 5;        ///< after one to warm up
  bool has_tbb = false, has_std = false;
};

/// Seconds of each repeat. The ways take turns.
struct sort_times {
  std::vector<double> device;  ///< by events, from the first kernel's start to the last one's end
  std::vector<double> wall;    ///< by the host's clock, from the call until the queue is empty
  std::vector<double> tbb, standard;
  std::map<std::string, double> steps;  ///< least milliseconds of each kernel's calls together
  double compile_ms = 0;
};

/// Throws std::runtime_error if the order differs from std::stable_sort's.
template <class Key>
sort_times measure_sort(runtime::queue q, const sort_plan& plan);

extern template sort_times measure_sort<std::uint32_t>(runtime::queue, const sort_plan&);
extern template sort_times measure_sort<std::uint64_t>(runtime::queue, const sort_plan&);

}  // namespace facet::bench
