// What is tuned, in which order, and the values that are tried.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/tuning_workloads.hpp"
#include "tracer/choices.hpp"

namespace facet::study {

struct tunable {
  std::string name;   ///< "layout"
  std::string about;  ///< what it decides
  /// The values to try beside what was chosen so far.
  std::vector<tracer::choices> (*values)(const tracer::choices& so_far, const runtime::device& d);
  /// Whether one of them may change the time that the workload takes.
  bool (*matters)(const tracer::choices& so_far, const tuning_workload& w);
  /// A value as it is printed: "wide, packets", "8x4".
  std::string (*text)(const tracer::choices& c);
};

/// In the order in which they are decided: the way to trace, then the sizes that depend on it.
std::span<const tunable> tunables();

/// Throws std::out_of_range.
const tunable& tunable_of(const std::string& name);

}  // namespace facet::study
