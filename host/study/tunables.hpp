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
  /// What pictures are timed by: the host's clock, until the picture is there, in place of the
  /// device's events, which do not see what passes between launches.
  bool by_host_clock;
  /// A value as it is printed: "wide, packets", "8x4".
  std::string (*text)(const tracer::choices& c);
};

/// In the order in which they are decided: the ways to trace and to make a picture, then the sizes
/// that depend on them.
std::span<const tunable> tunables();

/// Throws std::out_of_range.
const tunable& tunable_of(const std::string& name);

}  // namespace facet::study
