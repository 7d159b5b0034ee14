#include "study/variant_run.hpp"

#include <algorithm>
#include <optional>
#include <random>

#include "study/fingerprint.hpp"
#include "study/forecast.hpp"
#include "study/picture_rays.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::study {
namespace {

using tracer::clock;
using tracer::milliseconds_since;

/// Thrown inside, once `cancel` became true.
struct stopped {};

/// The variants under way, their scenes on the device among them.
class run {
 public:
  run(const runtime::queue& queue, const scene& s, const variant_settings& settings,
      variants_result& result, const tracer::progress& on_progress, const std::atomic<bool>* cancel)
      : queue_(queue),
        scene_(s),
        settings_(settings),
        result_(result),
        on_progress_(on_progress),
        cancel_(cancel),
        time_(result.variants.size() + 1) {
    const auto start = clock::now();
    exact_.emplace(s);
    const auto check = [this] { stop_if_asked(); };
    hits_.emplace(s, *exact_, settings.threads, check);
    rays_[0] = eye_rays(s, settings.width, settings.height);
    rays_[1] = bounce_rays(s, rays_[0], settings.seed, settings.threads);
    for (std::size_t k = 0; k < 2; ++k) expected_[k] = hits_->trace(rays_[k]);
    picture_.emplace(s, *exact_, settings.width, settings.height, result.max_depth,
                     settings.threads, check);
    result.oracle_ms = milliseconds_since(start);
    time_.tried(result.oracle_ms, 0, 0);
    tell();
  }

  void warm_up() {
    under_way_.resize(result_.variants.size());
    for (std::size_t i = 0; i < under_way_.size(); ++i) {
      stop_if_asked();
      warm_up(i);
      tell();
    }
    counting_.reset();
  }

  void measure() {
    for (const std::uint32_t which : shuffled()) {
      stop_if_asked();
      measure(which);
      result_.order.push_back(which);
      tell();
    }
  }

 private:
  struct entry {
    std::optional<tracer::device_scene> on;
    picture first;
    double repeat_ms = 0;  ///< what a timed run takes, to forecast
  };

  void stop_if_asked() const {
    if (cancel_ && cancel_->load()) throw stopped();
  }

  void tell() const {
    if (on_progress_)
      on_progress_(std::uint64_t(time_.spent_ms()), std::uint64_t(time_.total_ms()));
  }

  tracer::options options_for(const listed_variant& v) const {
    tracer::options o = v.options;
    o.tile_width = settings_.width, o.tile_height = settings_.height;
    return o;
  }

  picture render(tracer::device_scene& on, std::uint32_t max_depth, tracer::statistics& stats) {
    try {
      return on.render(settings_.width, settings_.height, max_depth, &stats, {}, cancel_);
    } catch (const tracer::cancelled&) {
      throw stopped();
    }
  }

  void warm_up(std::size_t which) {
    variant_result& v = result_.variants[which];
    const auto start = clock::now();
    try {
      try_out(v, under_way_[which]);
      v.is_judged = true;
    } catch (const runtime::exception& e) {
      if (which == 0) throw;
      v.state = variant_state::refused;
      v.reason = e.what();
      under_way_[which] = {};
      time_.refused();
      return;
    }
    time_.tried(milliseconds_since(start), under_way_[which].repeat_ms, settings_.repeats);
  }

  void try_out(variant_result& v, entry& e) {
    e.on.emplace(queue_, scene_, options_for(v.of));
    tracer::statistics stats;
    auto start = clock::now();
    e.first = render(*e.on, v.of.max_depth, stats);
    v.warm_up_ms = milliseconds_since(start);
    e.repeat_ms = stats.wall_ms;
    const tracer::kernel_description kernel = e.on->describe_render(v.of.max_depth);
    v.kernel_hash = fingerprint_of(kernel);
    v.text_hash = fingerprint_of(kernel.text);
    v.compiler_options = kernel.options;
    v.group_items = kernel.group_items;
    v.features = stats.features, v.geometry = stats.geometry;
    v.tree_depth = stats.tree_depth, v.tree_nodes = stats.tree_nodes;
    v.device_bytes = stats.device_bytes;
    v.upload_ms = stats.upload_ms, v.build_ms = stats.build_ms;
    v.compile_ms = stats.compile_ms;
    v.rays = rays_of_picture(v, stats);
    const picture& strict = under_way_[0].first;
    if (v.of.is_shading_only) {
      for (std::size_t k = 0; k < 2; ++k) v.hits[k].errors = result_.variants[0].hits[k].errors;
    } else {
      for (std::size_t k = 0; k < 2; ++k) {
        tracer::statistics s;
        std::vector<tracer::hit> found = e.on->trace(rays_[k].rays, false, 1, &s);
        v.compile_ms = s.compile_ms;
        e.repeat_ms += s.wall_ms;
        if (&v == &result_.variants[0]) strict_[k] = found;
        v.hits[k].errors = hits_->judge(rays_[k], expected_[k], found, strict_[k]);
      }
    }
    v.picture_error = picture_->judge(e.first, strict);
  }

  std::uint64_t rays_of_picture(const variant_result& v, const tracer::statistics& plain) {
    const variant_result& strict = result_.variants[0];
    if (&v != &strict && !v.of.is_shading_only) return strict.rays;
    const tracer::options counted = options_for(v.of);
    const bool is_plain = counted.edits.empty();  // strict kernels, of any depth
    if (!is_plain || !counting_) counting_.emplace(queue_, scene_, counting_rays(counted));
    tracer::statistics stats;
    render(*counting_, v.of.max_depth, stats);
    if (!is_plain) counting_.reset();
    return rays_of(stats, plain).total();
  }

  void measure(std::uint32_t which) {
    variant_result& v = result_.variants[which];
    entry& e = under_way_[which];
    const auto start = clock::now();
    tracer::statistics stats;
    const picture p = render(*e.on, v.of.max_depth, stats);
    v.is_repeatable = v.is_repeatable && differing_pixels(p, e.first) == 0;
    v.picture.ms.push_back(stats.kernel_ms.at(0));
    if (!v.of.is_shading_only)
      for (std::size_t k = 0; k < 2; ++k) {
        e.on->trace(rays_[k].rays, false, 1, &stats);
        if (!stats.kernel_ms.empty()) v.hits[k].kernel.ms.push_back(stats.kernel_ms[0]);
      }
    if (v.picture.ms.size() == settings_.repeats) v.state = variant_state::measured;
    time_.timed(milliseconds_since(start), e.repeat_ms);
  }

  /// Each variant that runs as often as it is repeated, in an order that the seed alone decides.
  std::vector<std::uint32_t> shuffled() const {
    std::vector<std::uint32_t> order;
    for (std::uint32_t i = 0; i < under_way_.size(); ++i)
      if (under_way_[i].on) order.insert(order.end(), settings_.repeats, i);
    std::mt19937_64 random(settings_.seed);
    for (std::size_t left = order.size(); left > 1; --left)  // Fisher and Yates
      std::swap(order[left - 1], order[random() % left]);
    return order;
  }

  runtime::queue queue_;
  const scene& scene_;
  const variant_settings& settings_;
  variants_result& result_;
  const tracer::progress& on_progress_;
  const std::atomic<bool>* cancel_;
  forecast time_;
  std::optional<reference::tracer<double>> exact_;
  std::optional<hit_oracle> hits_;
  std::optional<picture_oracle> picture_;
  std::array<ray_set, 2> rays_;
  std::array<std::vector<reference::hit<double>>, 2> expected_;
  std::array<std::vector<tracer::hit>, 2> strict_;
  std::optional<tracer::device_scene> counting_;  ///< the strict kernels, which count
  std::vector<entry> under_way_;
};

}  // namespace

void run_variants(const runtime::queue& queue, const scene& s,
                  const std::vector<listed_variant>& variants, const variant_settings& settings,
                  variants_result& result, const tracer::progress& on_progress,
                  const std::atomic<bool>* cancel) {
  result.from = origin_now(queue.get_device());
  result.settings = settings;
  result.scene_name = s.name;
  result.scene_hash = fingerprint_of(s);
  result.triangles = s.placed_triangle_count();
  result.instances = s.instances.size();
  result.samples = s.samples;
  result.max_depth = variants.at(0).max_depth;
  for (const listed_variant& v : variants) result.variants.emplace_back().of = v;
  try {
    run under_way(queue, s, result.settings, result, on_progress, cancel);
    under_way.warm_up();
    under_way.measure();
    result.complete = true;
  } catch (const stopped&) {
  } catch (...) {
    conclude(result);
    throw;
  }
  // Rays of a variant that changes shading alone are traced by the strict one's kernel.
  for (variant_result& v : result.variants)
    if (v.of.is_shading_only)
      for (std::size_t k = 0; k < 2; ++k) v.hits[k].kernel = result.variants[0].hits[k].kernel;
  conclude(result);
}

}  // namespace facet::study
