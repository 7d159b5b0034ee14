#include "study/sweep.hpp"

#include <algorithm>
#include <bit>
#include <optional>
#include <random>

#include "image/compare.hpp"
#include "reference/tracer.hpp"
#include "study/fingerprint.hpp"
#include "study/forecast.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::study {
namespace {

using tracer::clock;
using tracer::milliseconds_since;

/// Thrown inside, once `cancel` became true.
struct stopped {};

/// The forecast, told on.
struct progress_of {
  forecast& time;
  const tracer::progress& on_progress;

  void tell() const {
    if (on_progress) on_progress(std::uint64_t(time.spent_ms()), std::uint64_t(time.total_ms()));
  }
};

/// Bits, not values: equal NaNs are equal, and 0 is not -0.
void compare_bits(const picture& expected, const picture& found, shape_result& r) {
  const auto is_same = [](float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
  };
  for (std::uint32_t y = 0; y < expected.height; ++y)
    for (std::uint32_t x = 0; x < expected.width; ++x) {
      const float *a = expected.at(x, y), *b = found.at(x, y);
      if (std::equal(a, a + 4, b, is_same)) continue;
      if (r.differs++ == 0) r.differs_x = x, r.differs_y = y;
    }
}

/// Too large for the kernel or the device; registers run out only as the kernel is launched.
bool is_refusal(const runtime::exception& e) {
  constexpr int out_of_resources = -5;  // CL_OUT_OF_RESOURCES
  return e.code() == runtime::errc::nd_range || e.cl_code() == out_of_resources;
}

/// One experiment under way.
class run {
 public:
  run(const runtime::queue& queue, const experiment& e, const sweep_settings& s,
      experiment_result& r, progress_of progress, const std::atomic<bool>* cancel)
      : of_(e),
        settings_(s),
        result_(r),
        progress_(progress),
        cancel_(cancel),
        device_(queue, *e.what, options_for(e, s)) {
    describe();
    if (settings_.serial_repeats == 0) return;
    const auto start = clock::now();
    serial_.emplace(*e.what);
    result_.serial.build_ms = milliseconds_since(start);
  }

  void warm_up() {
    for (std::uint32_t i = 0; i < result_.shapes.size(); ++i) {
      warm_up(i);
      progress_.tell();
    }
    if (!serial_) return;
    const auto start = clock::now();
    const picture p = serial_picture();
    const double ms = picture_ms_.back() = milliseconds_since(start);
    progress_.time.tried(ms, ms, settings_.serial_repeats);
    if (!expected_.rgba.empty())
      result_.serial.pixels_off = image::compare(expected_, p).pixels_off;
  }

  void measure() {
    for (const std::uint32_t which : shuffled()) {
      const bool is_serial = which == result_.shapes.size();
      if (is_serial ? measure_serial() : measure(which)) result_.order.push_back(which);
      progress_.tell();
    }
  }

 private:
  static tracer::options options_for(const experiment& e, const sweep_settings& s) {
    tracer::options o = s.tracer;
    o.packets = tracer::packet_kind::off;  // a pixel a work-item
    o.tree = e.tree;
    if (o.tile_width == 0) o.tile_width = e.width, o.tile_height = e.height;
    return o;
  }

  void describe() {
    const scene& s = *of_.what;
    const tracer::kernel_description kernel = device_.describe_render(of_.max_depth);
    result_.name = of_.name;
    result_.scene_name = s.name;
    result_.scene_hash = fingerprint_of(s);
    result_.triangles = s.placed_triangle_count();
    result_.instances = s.instances.size();
    result_.width = of_.width, result_.height = of_.height, result_.max_depth = of_.max_depth;
    result_.samples = s.samples;
    result_.tree = tracer::word_of(of_.tree);
    result_.kernel_hash = fingerprint_of(kernel);
    result_.text_hash = fingerprint_of(kernel.text);
    result_.options = kernel.options;
    result_.group_items = kernel.group_items;
    for (const shape& of : settings_.shapes) result_.shapes.emplace_back().of = of;
    picture_ms_.resize(result_.shapes.size() + 1);
  }

  picture render(const shape& s, tracer::statistics& stats) {
    if (s.is_driver())
      device_.leave_work_group_to_driver();
    else
      device_.set_work_group(s.width, s.height);
    try {
      return device_.render(of_.width, of_.height, of_.max_depth, &stats, {}, cancel_);
    } catch (const tracer::cancelled&) {
      throw stopped();
    }
  }

  /// Marks a picture that is not the first shape's; false if so.
  bool verify(const picture& found, shape_result& s) {
    if (expected_.rgba.empty()) {
      expected_ = found;
      first_ = s.of.text();
    }
    compare_bits(expected_, found, s);
    if (s.differs == 0) return true;
    s.state = standing::different;
    s.reason = std::to_string(s.differs) + " of " +
               std::to_string(std::uint64_t(of_.width) * of_.height) + " pixels differ from " +
               first_ + "'s, the first at (" + std::to_string(s.differs_x) + ", " +
               std::to_string(s.differs_y) + ")";
    return false;
  }

  void warm_up(std::uint32_t which) {
    shape_result& s = result_.shapes[which];
    tracer::statistics stats;
    const auto start = clock::now();
    try {
      const picture p = render(s.of, stats);
      s.warm_up_ms = milliseconds_since(start);
      picture_ms_[which] = stats.wall_ms;
      take_facts(stats);
      progress_.time.tried(s.warm_up_ms, stats.wall_ms, verify(p, s) ? settings_.repeats : 0);
    } catch (const runtime::exception& e) {
      if (!is_refusal(e)) throw;
      s.state = standing::refused;
      s.reason = e.what();
      progress_.time.refused();
    }
  }

  void take_facts(const tracer::statistics& stats) {
    result_.features = stats.features;
    result_.geometry = stats.geometry;
    result_.tree_depth = stats.tree_depth;
    result_.tree_nodes = stats.tree_nodes;
    result_.device_bytes = stats.device_bytes;
    result_.compile_ms = stats.compile_ms;
    result_.upload_ms = stats.upload_ms;
    result_.build_ms = stats.build_ms;
  }

  /// False if there is no time to show for it.
  bool measure(std::uint32_t which) {
    shape_result& s = result_.shapes[which];
    if (s.state != standing::unfinished) return false;  // refused or different
    tracer::statistics stats;
    const picture p = render(s.of, stats);
    if (!verify(p, s)) {
      progress_.time.drop(picture_ms_[which], settings_.repeats - s.kernel.ms.size());
      return false;
    }
    s.kernel.ms.push_back(stats.kernel_ms.at(0));
    s.wall.ms.push_back(stats.wall_ms);
    if (s.kernel.ms.size() == settings_.repeats) s.state = standing::measured;
    progress_.time.timed(stats.wall_ms, picture_ms_[which]);
    return true;
  }

  picture serial_picture() {
    const auto go_on = [&](std::uint64_t, std::uint64_t) { return !(cancel_ && cancel_->load()); };
    picture p = of_.tree == tracer::tree_kind::none
                    ? serial_->render_without_tree(of_.width, of_.height, of_.max_depth, go_on)
                    : serial_->render(of_.width, of_.height, of_.max_depth, go_on);
    if (!go_on(0, 0)) throw stopped();
    return p;
  }

  bool measure_serial() {
    const auto start = clock::now();
    serial_picture();
    result_.serial.wall.ms.push_back(milliseconds_since(start));
    progress_.time.timed(result_.serial.wall.ms.back(), picture_ms_.back());
    return true;
  }

  /// Each configuration as often as it is repeated, in an order that the seed alone decides.
  std::vector<std::uint32_t> shuffled() const {
    const auto shapes = std::uint32_t(result_.shapes.size());
    std::vector<std::uint32_t> order(settings_.serial_repeats, shapes);
    for (std::uint32_t i = 0; i < shapes; ++i) order.insert(order.end(), settings_.repeats, i);
    std::mt19937_64 random(settings_.seed);
    for (std::size_t left = order.size(); left > 1; --left)  // Fisher and Yates
      std::swap(order[left - 1], order[random() % left]);
    return order;
  }

  const experiment& of_;
  const sweep_settings& settings_;
  experiment_result& result_;
  progress_of progress_;
  const std::atomic<bool>* cancel_;
  tracer::device_scene device_;
  std::optional<reference::tracer<float>> serial_;
  picture expected_;
  std::string first_;               ///< the shape that expected_ is of
  std::vector<double> picture_ms_;  ///< of each shape, and of the serial reference, to forecast
};

}  // namespace

void run_sweep(const runtime::queue& queue, const std::vector<experiment>& experiments,
               const sweep_settings& settings, sweep_result& result,
               const tracer::progress& on_progress, const std::atomic<bool>* cancel) {
  forecast time(experiments.size() * (settings.shapes.size() + (settings.serial_repeats ? 1 : 0)));
  result = {};
  result.from = origin_now(queue.get_device());
  result.settings = settings;
  for (const experiment& e : experiments) {
    if (cancel && cancel->load()) return;
    experiment_result& r = result.experiments.emplace_back();
    try {
      run under_way(queue, e, settings, r, {time, on_progress}, cancel);
      under_way.warm_up();
      under_way.measure();
      r.complete = true;
    } catch (const stopped&) {
    } catch (...) {
      conclude(r, settings);
      throw;
    }
    conclude(r, settings);
    if (!r.complete) return;
  }
  result.complete = true;
}

}  // namespace facet::study
