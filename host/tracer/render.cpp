// Pictures, tile by tile: device_scene::render.
#include <algorithm>

#include "scene/error.hpp"
#include "scene/media.hpp"
#include "tracer/state.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {
namespace {

/// What a launch should take: no watchdog fires, progress moves, Ctrl-C is answered.
constexpr double launch_ms = 50;

struct tile {
  std::uint32_t left, top, right, bottom;
  std::uint64_t pixels() const { return std::uint64_t(right - left) * (bottom - top); }
};

/// Hands out the picture's tiles from the top left, row by row. With no size given a tile is as
/// many whole rows as the last one's speed says fit into launch_ms, and at most 4 times more than
/// before; the first is a 32nd of the picture.
class tiler {
 public:
  tiler(std::uint32_t width, std::uint32_t height, const options& o, std::uint32_t group_height)
      : width_(width),
        height_(height),
        fixed_width_(o.tile_width),
        fixed_height_(o.tile_height),
        step_(group_height),
        rows_(round_up(std::max(1u, height / 32))) {}

  bool next(tile& t) {
    if (top_ >= height_) return false;
    const std::uint32_t w = fixed_width_ ? fixed_width_ : width_;
    const std::uint32_t h = fixed_height_ ? fixed_height_ : rows_;
    t = {left_, top_, std::min(width_, left_ + std::min(w, width_)),
         std::min(height_, top_ + std::min(h, height_))};
    if (t.right == width_)
      left_ = 0, top_ = t.bottom;
    else
      left_ = t.right;
    return true;
  }

  void took(const tile& t, double ms) {
    const double fits = (t.bottom - t.top) * launch_ms / std::max(ms, 1e-3);
    rows_ = round_up(std::uint32_t(std::clamp(fits, 1.0, 4.0 * rows_)));
  }

 private:
  std::uint32_t round_up(std::uint32_t rows) const {
    return std::min(height_ + step_, (rows + step_ - 1) / step_ * step_);
  }

  std::uint32_t width_, height_, fixed_width_, fixed_height_, step_, rows_;
  std::uint32_t left_ = 0, top_ = 0;
};

struct group_size {
  std::uint32_t width, height;  ///< work-items; 0 x 0: the driver chooses
};

group_size group_of(const options& o, const tuning& t, bool in_packets) {
  if (o.driver_group) return {0, 0};
  const group_size usual = in_packets ? group_size{t.packet_group, 1}
                                      : group_size{t.render_group_width, t.render_group_height};
  return {o.group_width ? o.group_width : usual.width,
          o.group_height ? o.group_height : usual.height};
}

/// Pixels of a work-item.
struct item_size {
  std::uint32_t width, height;
};

item_size item_of(bool in_packets) {
  return in_packets ? item_size{FACET_PACKET_COLUMNS, FACET_PACKET / FACET_PACKET_COLUMNS}
                    : item_size{1, 1};
}

/// The tile padded to whole work-groups; the kernel guards.
void launch_over(runtime::handler& h, const tile& t, item_size item, group_size g,
                 const runtime::kernel& kernel) {
  const std::size_t width = (t.right - t.left + item.width - 1) / item.width,
                    height = (t.bottom - t.top + item.height - 1) / item.height;
  if (g.width == 0) return h.parallel_for(runtime::range<2>(width, height), kernel);
  const std::size_t columns = (width + g.width - 1) / g.width,
                    rows = (height + g.height - 1) / g.height;
  h.parallel_for(runtime::nd_range<2>({columns * g.width, rows * g.height}, {g.width, g.height}),
                 kernel);
}

void check_size(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth) {
  if (width == 0 || height == 0 || width > limits::image_side || height > limits::image_side)
    throw scene_error("", "",
                      "a picture of " + std::to_string(width) + "x" + std::to_string(height) +
                          " was asked for; each side may be 1 to " +
                          std::to_string(limits::image_side) + " pixels");
  if (max_depth > limits::max_depth)
    throw scene_error("", "",
                      "a depth of " + std::to_string(max_depth) + " was asked for; at most " +
                          std::to_string(limits::max_depth) + " is allowed");
}

}  // namespace

picture device_scene::render(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                             statistics* stats, const progress& on_progress,
                             const std::atomic<bool>* cancel) {
  check_size(width, height, max_depth);
  state& s = *state_;
  check_camera_media(s.model, s.camera_media);
  const View view = pack_view(s.model, s.camera_media, width, height, max_depth);
  const group_size group = group_of(s.chosen, s.tuned, s.in_packets);
  const item_size item = item_of(s.in_packets);
  runtime::kernel kernel = s.render_kernel(max_depth);

  const std::uint64_t total = std::uint64_t(width) * height;
  runtime::buffer<View> view_buffer(&view, 1);
  runtime::buffer<texel> pixels(total);
  const auto launch = [&](const tile& t) {
    return s.queue.submit([&](runtime::handler& g) {
      std::uint32_t k = s.set_geometry(g);
      k = s.set_normals(g, k);
      g.set_arg(k++, runtime::accessor{s.lights, g, runtime::read_only});
      g.set_arg(k++, runtime::accessor{view_buffer, g, runtime::read_only});
      g.set_arg(k++, runtime::accessor{pixels, g, runtime::read_write});
      g.set_arg(k++, t.left);
      g.set_arg(k++, t.top);
      g.set_arg(k++, t.right);
      g.set_arg(k++, t.bottom);
      launch_over(g, t, item, group, kernel);
    });
  };

  // The first launch of a work-group size may compile (PoCL does): one pixel pays for it.
  launch({0, 0, 1, 1}).wait_and_throw();
  s.clear_faults();
  const auto start = clock::now();
  std::uint64_t done = 0;
  double kernel_ms = 0;
  std::uint32_t tiles = 0;
  tiler tiles_left(width, height, s.chosen, std::max(1u, group.height) * item.height);
  for (tile t{}; tiles_left.next(t);) {
    if (cancel && cancel->load()) throw cancelled(done, total);
    const runtime::event finished = launch(t);
    finished.wait_and_throw();
    const double ms = finished.milliseconds();
    tiles_left.took(t, ms);
    kernel_ms += ms;
    done += t.pixels();
    ++tiles;
    if (on_progress) on_progress(done, total);
  }
  picture result(width, height);
  {
    const runtime::host_accessor read{pixels, runtime::read_only};
    for (std::size_t i = 0; i < total; ++i)
      std::copy(read[i].begin(), read[i].end(), result.rgba.begin() + std::ptrdiff_t(4 * i));
  }
  if (stats) {
    *stats = {};
    s.describe(*stats);
    stats->kernel_ms = {kernel_ms};
    stats->rays = total * s.model.samples * s.model.samples;
    stats->group_width = group.width;
    stats->group_height = group.height;
    stats->tiles = tiles;
    const Faults faults = s.read_faults();
    stats->refused = faults.refused;
    stats->crowded = faults.crowded;
    stats->wall_ms = milliseconds_since(start);
  }
  return result;
}

}  // namespace facet::tracer
