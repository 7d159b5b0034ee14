#include "study/tuning_run.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <random>

#include "study/fingerprint.hpp"
#include "study/tunables.hpp"
#include "tracer/stopwatch.hpp"
#include "tracer/tuning.hpp"

namespace facet::study {
namespace {

using tracer::clock;
using tracer::milliseconds_since;

constexpr unsigned rounds_to_judge_by = 3;  // whether it is worth more of them

/// Thrown inside, once `cancel` became true.
struct stopped {};

/// What the defaults give.
struct expectation {
  std::vector<tracer::hit> hits;
  picture pixels;
};

/// How many of `expected` and `found` differ by a bit, and the first.
struct difference {
  std::uint64_t count = 0, first = 0, of = 0;
};

/// `unit` floats or words belong together: a pixel, a hit.
difference difference_of(const void* expected, const void* found, std::uint64_t count,
                         std::size_t unit_bytes) {
  difference d;
  d.of = count;
  if (count == 0 || std::memcmp(expected, found, count * unit_bytes) == 0) return d;
  const auto *a = static_cast<const char*>(expected), *b = static_cast<const char*>(found);
  for (std::uint64_t k = 0; k < count; ++k)
    if (std::memcmp(a + k * unit_bytes, b + k * unit_bytes, unit_bytes) != 0)
      if (d.count++ == 0) d.first = k;
  return d;
}

bool is_refusal(const runtime::exception& e) {
  constexpr int out_of_resources = -5;  // CL_OUT_OF_RESOURCES: registers run out at the launch
  return e.code() == runtime::errc::nd_range || e.code() == runtime::errc::build ||
         e.code() == runtime::errc::memory_allocation || e.cl_code() == out_of_resources;
}

class tuning_under_way {
 public:
  tuning_under_way(const runtime::queue& queue, const std::vector<tuning_scene>& scenes,
                   tuning_result& result, const tuning_watch& watch,
                   const std::atomic<bool>* cancel)
      : queue_(queue),
        scenes_(scenes),
        settings_(result.settings),
        result_(result),
        watch_(watch),
        cancel_(cancel),
        random_(settings_.seed) {}

  void prepare() {
    for (std::uint32_t k = 0; k < scenes_.size(); ++k) {
      stop_if_asked();
      tracer::device_scene on = place(k, result_.usual);
      for (tuning_workload& w : workloads_of(on, scenes_[k], k)) {
        result_.workloads.push_back(facts_of(w));
        expectation& e = expected_.emplace_back();
        workloads_.push_back(std::move(w));
        run(on, workloads_.back(), &e.hits, &e.pixels);
      }
    }
  }

  void decide(const tunable& t) {
    choice_result c;
    c.name = t.name;
    for (std::uint32_t w = 0; w < workloads_.size(); ++w)
      if (t.matters(result_.values, workloads_[w])) c.workloads.push_back(w);
    add_trials(t, c);
    if (c.workloads.empty() || c.trials.size() < 2) return;
    runs_ = 0;
    most_runs_ =
        c.workloads.size() * (c.trials.size() * (1 + settings_.rounds) + 2 * settings_.rounds);
    std::vector<contestant> all(c.trials.size());
    for (std::size_t k = 0; k < all.size(); ++k) warm_up(c, k, all[k]);
    time_in_turns(c, all);
    c.challenger = challenger_of(c, settings_);
    if (c.challenger) confirm(c, all);
    c.taken = taken_of(c, settings_);
    result_.values = c.trials[c.taken].as;
    result_.choices.push_back(std::move(c));
    if (watch_.on_choice) watch_.on_choice(result_.choices.back());
  }

 private:
  /// A trial's scenes on the device, by number; none once it is out.
  using contestant = std::map<std::uint32_t, tracer::device_scene>;
  using samples = std::vector<std::vector<double>>;

  void stop_if_asked() const {
    if (cancel_ && cancel_->load()) throw stopped();
  }

  tracer::device_scene place(std::uint32_t k, const tracer::choices& as) const {
    const tuning_scene& s = scenes_[k];
    tracer::options o = settings_.tracer;
    o.defaults = as;
    o.tile_width = s.width, o.tile_height = s.height;  // a picture is one tile
    return tracer::device_scene(queue_, s.what, o);
  }

  workload_facts facts_of(const tuning_workload& w) const {
    const scene& s = scenes_[w.scene].what;
    return {w.name,        s.name,  fingerprint_of(s), s.placed_triangle_count(),
            w.rays.size(), w.width, w.height,          w.max_depth};
  }

  static void add_trials(const tunable& t, choice_result& c, const tracer::choices& as) {
    const bool is_there = std::any_of(c.trials.begin(), c.trials.end(),
                                      [&](const trial& other) { return other.as == as; });
    if (is_there) return;
    trial& one = c.trials.emplace_back();
    one.value = t.text(as);
    one.as = as;
    one.ms.resize(c.workloads.size());
  }

  void add_trials(const tunable& t, choice_result& c) const {
    add_trials(t, c, result_.values);
    for (const tracer::choices& as : t.values(result_.values, queue_.get_device()))
      add_trials(t, c, as);
  }

  tracer::statistics run(tracer::device_scene& on, const tuning_workload& w,
                         std::vector<tracer::hit>* hits, picture* pixels) {
    stop_if_asked();
    tracer::statistics stats;
    if (!w.is_picture) {
      *hits = on.trace(w.rays, w.any, settings_.repeats, &stats);
    } else {
      try {
        *pixels = on.render(w.width, w.height, w.max_depth, &stats, {}, cancel_);
      } catch (const tracer::cancelled&) {
        throw stopped();
      }
    }
    return stats;
  }

  double run_and_check(const choice_result& c, const trial& t, contestant& on,
                       std::uint32_t which) {
    const tuning_workload& w = workloads_[which];
    const expectation& e = expected_[which];
    std::vector<tracer::hit> hits;
    picture pixels;
    const tracer::statistics stats = run(on.at(w.scene), w, &hits, &pixels);
    static_assert(sizeof(tracer::hit) == 20, "fields without padding: bits can be compared");
    const difference d =
        w.is_picture ? difference_of(e.pixels.rgba.data(), pixels.rgba.data(),
                                     std::uint64_t(w.width) * w.height, 4 * sizeof(float))
                     : difference_of(e.hits.data(), hits.data(), hits.size(), sizeof(tracer::hit));
    if (d.count > 0)
      throw tuning_difference(c.name + " " + t.value + ": " + std::to_string(d.count) + " of " +
                              std::to_string(d.of) + (w.is_picture ? " pixels" : " hits") +
                              " of \"" + w.name + "\" are not those of the defaults, the first " +
                              "number " + std::to_string(d.first));
    if (watch_.on_run) watch_.on_run(c.name, ++runs_, most_runs_);
    return summarize(stats.kernel_ms).median;
  }

  void warm_up(choice_result& c, std::size_t k, contestant& on) {
    trial& t = c.trials[k];
    const auto start = clock::now();
    try {
      for (const std::uint32_t w : c.workloads) {
        const std::uint32_t s = workloads_[w].scene;
        if (!on.contains(s)) on.emplace(s, place(s, t.as));
        run_and_check(c, t, on, w);
      }
    } catch (const runtime::exception& e) {
      if (k == 0 || !is_refusal(e)) throw;
      t.refused = e.what();
      on.clear();
    }
    t.warm_up_ms = milliseconds_since(start);
  }

  /// One round: appends a time of each workload to each of the trials `who`.
  void round(const choice_result& c, std::vector<std::uint32_t> who, std::vector<contestant>& all,
             const std::function<samples&(std::uint32_t trial)>& to) {
    for (std::size_t w = 0; w < c.workloads.size(); ++w) {
      for (std::size_t left = who.size(); left > 1; --left)  // Fisher and Yates
        std::swap(who[left - 1], who[random_() % left]);
      for (const std::uint32_t k : who)
        to(k)[w].push_back(run_and_check(c, c.trials[k], all[k], c.workloads[w]));
    }
  }

  void time_in_turns(choice_result& c, std::vector<contestant>& all) {
    for (unsigned r = 0; r < settings_.rounds; ++r) {
      std::vector<std::uint32_t> in;
      for (std::uint32_t k = 0; k < all.size(); ++k)
        if (!all[k].empty()) in.push_back(k);
      round(c, in, all, [&](std::uint32_t k) -> samples& { return c.trials[k].ms; });
      if (r + 1 == rounds_to_judge_by) drop_hopeless(c, all);
    }
    for (std::size_t k = 1; k < c.trials.size(); ++k)
      c.trials[k].relative = relative_to(c.trials[0].ms, c.trials[k].ms, settings_.drawing());
  }

  void drop_hopeless(const choice_result& c, std::vector<contestant>& all) const {
    for (std::size_t k = 1; k < all.size(); ++k) {
      const relative_time t = relative_to(c.trials[0].ms, c.trials[k].ms, settings_.drawing());
      if (!t.rounds.empty() &&
          *std::min_element(t.rounds.begin(), t.rounds.end()) > settings_.hopeless)
        all[k].clear();
    }
  }

  void confirm(choice_result& c, std::vector<contestant>& all) {
    samples kept(c.workloads.size()), own(c.workloads.size());
    for (unsigned r = 0; r < settings_.rounds; ++r)
      round(c, {0, *c.challenger}, all,
            [&](std::uint32_t k) -> samples& { return k == 0 ? kept : own; });
    c.confirmation = relative_to(kept, own, settings_.drawing());
  }

  runtime::queue queue_;
  const std::vector<tuning_scene>& scenes_;
  const tuning_settings& settings_;
  tuning_result& result_;
  const tuning_watch& watch_;
  const std::atomic<bool>* cancel_;
  std::mt19937_64 random_;
  std::vector<tuning_workload> workloads_;
  std::vector<expectation> expected_;  ///< by workload
  std::uint64_t runs_ = 0, most_runs_ = 0;
};

}  // namespace

void run_tuning(const runtime::queue& queue, const std::vector<tuning_scene>& scenes,
                const tuning_settings& settings, tuning_result& result, const tuning_watch& watch,
                const std::atomic<bool>* cancel) {
  result = {};
  result.from = origin_now(queue.get_device());
  result.settings = settings;
  result.usual = result.values = tracer::tuning_for(queue.get_device());
  tuning_under_way tuning(queue, scenes, result, watch, cancel);
  try {
    tuning.prepare();
    for (const tunable& t : tunables()) {
      const auto& only = settings.only;
      if (only.empty() || std::find(only.begin(), only.end(), t.name) != only.end())
        tuning.decide(t);
    }
    result.complete = true;
  } catch (const stopped&) {
  }
}

}  // namespace facet::study
