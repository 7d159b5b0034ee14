// Pictures, tile by tile: device_scene::render.
#include <algorithm>

#include "scene/error.hpp"
#include "scene/media.hpp"
#include "tracer/launch.hpp"
#include "tracer/sample_render.hpp"
#include "tracer/state.hpp"
#include "tracer/stopwatch.hpp"
#include "tracer/tiler.hpp"

namespace facet::tracer {
namespace {

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
  return in_packets ? item_size{FACET_PACKET_COLUMNS, FACET_PACKET_ROWS} : item_size{1, 1};
}

/// The tile padded to whole work-groups; the kernel guards.
void launch_over(runtime::handler& h, const tile& t, item_size item, group_size g,
                 const runtime::kernel& kernel) {
  const std::size_t width = (t.right - t.left + item.width - 1) / item.width,
                    height = (t.bottom - t.top + item.height - 1) / item.height;
  if (g.width == 0) return h.parallel_for(runtime::range<2>(width, height), kernel);
  h.parallel_for(padded(width, height, {g.width, g.height}), kernel);
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

runtime::program device_scene::state::compiled_to_render(const char* file,
                                                         std::uint32_t max_depth) const {
  return compiled(queue, kernels, file,
                  traversal_options(used, model.nesting, chosen.tree, in_images, geometry.is_wide,
                                    geometry.stack, max_depth, tuned) +
                      register_cap(tuned.trace_registers));
}

runtime::kernel device_scene::state::render_kernel(std::uint32_t max_depth) {
  if (!render_program || render_stack < max_depth) {
    render_program = compiled_to_render(render_file(), max_depth);
    render_stack = max_depth;
  }
  return render_program->get_kernel("render");
}

bool device_scene::state::has_samples_apart() const {
  return chosen.samples_apart.value_or(tuned.samples_apart) &&
         (model.samples > 1 || used.transparency) && chosen.group_width == 0 &&
         !chosen.driver_group && !in_packets;
}

sample_renderer& device_scene::state::sample_kernels(std::uint32_t max_depth,
                                                     std::uint64_t pixels) {
  if (!apart || !apart->suffices(max_depth, pixels)) {
    apart.reset();  // its memory is free before more is asked for
    apart = std::make_shared<sample_renderer>(*this, max_depth, pixels);
  }
  return *apart;
}

const char* device_scene::state::render_file() const {
  return in_packets ? "render_packets.cl" : "render.cl";
}

std::uint32_t device_scene::state::set_picture(runtime::handler& h, runtime::buffer<View>& view) {
  std::uint32_t k = set_normals(h, set_geometry(h));
  h.set_arg(k++, runtime::accessor{lights, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{view, h, runtime::read_only});
  return k;
}

kernel_description device_scene::describe_render(std::uint32_t max_depth) {
  state& s = *state_;
  if (s.has_samples_apart()) return s.sample_kernels(max_depth, 1).describe();
  const runtime::kernel kernel = s.render_kernel(max_depth);
  return {runtime::expand(s.kernels, s.render_file()), s.render_program->options(),
          kernel.work_group_size(s.queue.get_device())};
}

picture device_scene::render(std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                             statistics* stats, const progress& on_progress,
                             const std::atomic<bool>* cancel) {
  check_size(width, height, max_depth);
  state& s = *state_;
  check_camera_media(s.model, s.media());
  const View view = pack_view(s.model, s.media(), width, height, max_depth);
  const group_size group = group_of(s.chosen, s.tuned, s.in_packets);
  const item_size item = item_of(s.in_packets);

  const std::uint64_t total = std::uint64_t(width) * height;
  runtime::buffer<View> view_buffer(&view, 1);
  runtime::buffer<texel> pixels(total);
  sample_renderer* const apart =
      s.has_samples_apart() ? &s.sample_kernels(max_depth, total) : nullptr;
  const auto render_tile = [&](const tile& t) {
    if (apart) return apart->render(t, view_buffer, pixels);
    const runtime::kernel kernel = s.render_kernel(max_depth);
    const runtime::event done = s.queue.submit([&](runtime::handler& g) {
      std::uint32_t k = s.set_picture(g, view_buffer);
      g.set_arg(k++, runtime::accessor{pixels, g, runtime::read_write});
      for (const std::uint32_t x : {t.left, t.top, t.right, t.bottom}) g.set_arg(k++, x);
      launch_over(g, t, item, group, kernel);
    });
    done.wait_and_throw();
    return done.milliseconds();
  };

  // The first launch of a work-group size may compile (PoCL does): one pixel pays for it.
  render_tile({0, 0, 1, 1});
  s.clear_faults();
  const auto start = clock::now();
  std::uint64_t done = 0;
  double kernel_ms = 0;
  std::uint32_t tiles = 0;
  tiler tiles_left(width, height, s.chosen, std::max(1u, group.height) * item.height,
                   apart ? apart->most_pixels() : total);
  for (tile t{}; tiles_left.next(t);) {
    if (cancel && cancel->load()) throw cancelled(done, total);
    const double ms = render_tile(t);
    tiles_left.took(t, ms);
    kernel_ms += ms;
    done += t.pixels();
    ++tiles;
    if (on_progress) on_progress(done, total);
  }
  picture result(width, height);
  pixels.set_final_data(reinterpret_cast<texel*>(result.rgba.data()));
  pixels = runtime::buffer<texel>(1);  // the picture's memory goes, and is copied there first
  s.queue.throw_asynchronous();
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
