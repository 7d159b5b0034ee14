// What tuning a device found: every value that was tried, how long it took, and what was taken.
//
// The rule. Values of one choice take turns, round by round. A value's time relative to that of the
// value kept so far is, in each round, the geometric mean over the workloads that it matters to;
// its estimate is the median over the rounds, with a bootstrap interval. A value challenges if that
// interval lies below 1 - margin; of several the one of least median does. Since the luckiest of
// many looks fast, it is then timed in as many rounds again, beside the kept value alone, and is
// taken if those by themselves say the same. Otherwise the kept value stays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "study/provenance.hpp"
#include "study/statistics.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

struct tuning_settings {
  bool is_quick = false;          ///< small scenes: told in the file
  std::vector<std::string> only;  ///< names of tunables; empty: all
  unsigned rounds = 10;
  unsigned repeats = 1;  ///< launches of a workload of rays a round; the median counts
  double margin = 0.02;
  /// Not timed any more: what took more than so many times as long in each of its first 3 rounds.
  double hopeless = 1.5;
  std::uint32_t seed = 1;          ///< of the order and of the intervals
  std::uint32_t resamples = 2000;  ///< a bootstrap
  double level = 0.95;             ///< of the intervals
  tracer::options tracer;          ///< of all trials; its defaults are overridden

  resampling drawing() const { return {resamples, level, seed}; }
};

/// Time relative to the kept value's in the same round.
struct relative_time {
  std::vector<double> rounds;
  double median = 0;
  interval range;  ///< of the median
};

/// `own` and `kept`: milliseconds by workload, then by round, as many rounds of each as `own` has
/// at least. Throws std::invalid_argument for a time that is not greater than 0.
relative_time relative_to(const std::vector<std::vector<double>>& kept,
                          const std::vector<std::vector<double>>& own, const resampling& r);

/// By more than the spread and the margin.
bool is_faster(const relative_time& t, const tuning_settings& s);

/// One value of a choice.
struct trial {
  std::string value;
  tracer::choices as;     ///< it, with what was chosen before
  std::string refused;    ///< the device's reason; "": it was timed
  double warm_up_ms = 0;  ///< host clock: compiling, building trees, a first run of each
  std::vector<std::vector<double>> ms;  ///< by workload of the choice, then by round
  relative_time relative;               ///< without rounds for the kept value, and where refused
};

struct choice_result {
  std::string name;
  std::vector<std::uint32_t> workloads;  ///< that it matters to: indices
  std::vector<trial> trials;             ///< the value kept so far first
  std::optional<std::uint32_t> challenger;
  relative_time confirmation;  ///< the challenger's second rounds
  std::uint32_t taken = 0;     ///< index of a trial
};

/// The trial that may be taken if it is confirmed.
std::optional<std::uint32_t> challenger_of(const choice_result& c, const tuning_settings& s);
/// The trial that is taken: the challenger if it is confirmed, else the value kept so far.
std::uint32_t taken_of(const choice_result& c, const tuning_settings& s);

struct workload_facts {
  std::string name, scene_name, scene_hash;
  std::uint64_t triangles = 0;  ///< of all instances
  std::uint64_t rays = 0;       ///< 0 for a picture
  std::uint32_t width = 0, height = 0, max_depth = 0;
};

struct tuning_result {
  bool complete = false;
  origin from;
  tuning_settings settings;
  tracer::choices usual;  ///< what held before: the defaults by kind of device
  tracer::choices values;
  std::vector<workload_facts> workloads;
  std::vector<choice_result> choices;  ///< those that matter to a workload
};

}  // namespace facet::study
