// Tuning a device: the choices one after the other, each with those before it as they were taken
// (coordinate descent in a fixed order, once over).
//
// Each value is compiled for and run once on each workload, which is not timed; then it is timed by
// the rule of tuning_result.hpp, in an order that is random within each workload of each round.
// Every run, timed or not, must give the bits that the defaults by kind of device give.
#pragma once

#include <atomic>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/queue.hpp"
#include "study/tuning_result.hpp"
#include "study/tuning_workloads.hpp"

namespace facet::study {

/// A value gives other bits than the defaults: a mistake in a kernel or a driver. The message names
/// value and workload, how many rays or pixels differ, and the first.
class tuning_difference : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Told while it runs.
struct tuning_watch {
  /// Workloads that `choice` has run, and how many there will be at most.
  std::function<void(const std::string& choice, std::uint64_t done, std::uint64_t most)> on_run{};
  std::function<void(const choice_result&)> on_choice{};
};

/// `result` is complete unless `cancel` became true, after which this returns as soon as a launch
/// ends. A value that the device refuses (too large a work-group, memory, a compile error) is
/// marked, and the others go on. Throws what device_scene does for the defaults, and
/// tuning_difference.
void run_tuning(const runtime::queue& queue, const std::vector<tuning_scene>& scenes,
                const tuning_settings& settings, tuning_result& result,
                const tuning_watch& watch = {}, const std::atomic<bool>* cancel = nullptr);

}  // namespace facet::study
