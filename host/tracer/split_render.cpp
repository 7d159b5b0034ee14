#include "tracer/split_render.hpp"

#include <algorithm>

#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr const char* main_file = "render_split.cl";

/// Places of a tile's eye rays: whole blocks of pixels.
std::uint64_t places(const tile& t) {
  return std::uint64_t((t.width() + FACET_PACKET_COLUMNS - 1) / FACET_PACKET_COLUMNS) *
         ((t.height() + FACET_PACKET_ROWS - 1) / FACET_PACKET_ROWS) * FACET_PACKET;
}

}  // namespace

split_renderer::split_renderer(device_scene::state& s, std::uint32_t max_depth,
                               std::uint64_t pixels)
    : state_(s),
      max_depth_(max_depth),
      group_(s.tuned.group),
      capacity_(capacity_for(pixels)),
      program_(s.compiled_to_render(main_file, max_depth)),
      eye_(program_.get_kernel("eye_rays")),
      trace_(program_.get_kernel("trace_rays")),
      shade_(program_.get_kernel("shade_rays")),
      light_(program_.get_kernel("light_rays")),
      sum_(program_.get_kernel("sum_samples")),
      origins_(capacity_),
      directions_(capacity_),
      throughputs_(capacity_),
      hits_(capacity_),
      surfaces_(3 * capacity_),
      media_(s.used.transparency ? capacity_ * s.model.nesting : 1),
      hit_rays_(capacity_),
      tree_(capacity_),
      lit_hits_(std::max<std::size_t>(1, s.model.lights.size()) * capacity_),
      counts_(2 + s.model.lights.size()) {}

kernel_description split_renderer::describe() const {
  return {runtime::expand(state_.kernels, main_file), program_.options(),
          light_.work_group_size(state_.queue.get_device())};
}

std::uint64_t split_renderer::capacity_for(std::uint64_t pixels) const {
  const runtime::device d = state_.queue.get_device();
  const std::uint64_t each = 7 * sizeof(texel) + 8 + sizeof(RayNode) +
                             4 * (state_.model.nesting + state_.model.lights.size());
  const std::uint64_t wanted =
      state_.chosen.split_rays ? state_.chosen.split_rays : pixels * rays_a_pixel;
  const std::uint64_t largest = std::max(3 * sizeof(texel), 4 * state_.model.lights.size());
  const std::uint64_t most = std::min(
      {d.global_mem_size() / 8 / each, d.max_mem_alloc_size() / largest, std::uint64_t(1) << 23});
  return std::max(std::min(wanted, most), std::uint64_t(FACET_PACKET) * rays_a_pixel);
}

std::uint32_t split_renderer::set_rays(runtime::handler& h, std::uint32_t k) {
  h.set_arg(k++, runtime::accessor{origins_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{directions_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{throughputs_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{media_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{tree_, h, runtime::read_write});
  return k;
}

std::uint32_t split_renderer::set_surfaces(runtime::handler& h, std::uint32_t k) {
  h.set_arg(k++, runtime::accessor{hit_rays_, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{surfaces_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{lit_hits_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{counts_, h, runtime::read_write});
  return k;
}

void split_renderer::run(std::string name, const std::function<void(runtime::handler&)>& group) {
  done_.emplace_back(std::move(name), state_.queue.submit(group));
}

void split_renderer::eye_rays(const tile& t, std::uint32_t index, std::uint32_t count,
                              runtime::buffer<View>& view) {
  run("eye_rays", [&](runtime::handler& h) {
    std::uint32_t k = 0;
    h.set_arg(k++, runtime::accessor{view, h, runtime::read_only});
    k = set_rays(h, k);
    for (const std::uint32_t x : {t.left, t.top, t.right, t.bottom, index, count})
      h.set_arg(k++, x);
    h.parallel_for(padded(count, group_), eye_);
  });
}

void split_renderer::trace_rays(std::uint32_t depth, std::uint32_t first, std::uint32_t count,
                                runtime::buffer<View>& view) {
  run("trace_rays " + std::to_string(depth), [&](runtime::handler& h) {
    std::uint32_t k = state_.set_geometry(h);
    h.set_arg(k++, runtime::accessor{view, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{origins_, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{directions_, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{tree_, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{hits_, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{hit_rays_, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{counts_, h, runtime::read_write});
    for (const std::uint32_t x : {depth, first, count}) h.set_arg(k++, x);
    h.parallel_for(padded(count, group_), trace_);
  });
}

void split_renderer::shade_rays(std::uint32_t depth, std::uint32_t first_hit, std::uint32_t hits,
                                std::uint32_t eyes, runtime::buffer<View>& view) {
  run("shade_rays " + std::to_string(depth), [&](runtime::handler& h) {
    std::uint32_t k = state_.set_picture(h, view);
    k = set_rays(h, k);
    h.set_arg(k++, runtime::accessor{hits_, h, runtime::read_only});
    k = set_surfaces(h, k);
    for (const std::uint32_t x : {depth, first_hit, eyes, std::uint32_t(capacity_)})
      h.set_arg(k++, x);
    h.parallel_for(padded(hits, group_), shade_);
  });
}

void split_renderer::light_rays(std::uint32_t hits, std::uint32_t light) {
  run("light_rays " + std::to_string(light), [&](runtime::handler& h) {
    std::uint32_t k = state_.set_geometry(h);
    h.set_arg(k++, runtime::accessor{state_.lights, h, runtime::read_only});
    k = set_surfaces(h, set_rays(h, k));
    for (const std::uint32_t x : {light, std::uint32_t(capacity_)}) h.set_arg(k++, x);
    h.parallel_for(padded(hits, group_), light_);
  });
}

void split_renderer::sum_samples(const tile& t, std::uint32_t index, std::uint32_t count,
                                 runtime::buffer<View>& view, runtime::buffer<texel>& pixels) {
  run("sum_samples", [&](runtime::handler& h) {
    std::uint32_t k = 0;
    h.set_arg(k++, runtime::accessor{view, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{throughputs_, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{tree_, h, runtime::read_only});
    h.set_arg(k++, runtime::accessor{pixels, h, runtime::read_write});
    for (const std::uint32_t x : {t.left, t.top, t.right, t.bottom, index, count})
      h.set_arg(k++, x);
    h.parallel_for(padded(count, group_), sum_);
  });
}

/// One sample of each of the tile's pixels; false if the rays had no room.
bool split_renderer::sample(const tile& t, std::uint32_t index, runtime::buffer<View>& view,
                            runtime::buffer<texel>& pixels) {
  const auto eyes = std::uint32_t(places(t));
  run("fill", [&](runtime::handler& h) {
    const runtime::accessor all{counts_, h, runtime::write_only};
    h.fill(all, 0u);
  });
  eye_rays(t, index, eyes, view);
  std::uint32_t hits = 0, first = 0, count = eyes;
  for (std::uint32_t depth = 0; depth <= max_depth_ && count > 0; ++depth) {
    trace_rays(depth, first, count, view);
    shade_rays(depth, hits, count, eyes, view);
    first += count;
    if (depth == max_depth_) {
      hits += count;  // at most
      break;
    }
    const runtime::host_accessor counts{counts_, runtime::read_only};
    hits = counts[0];
    if (counts[1] > capacity_ - eyes) return false;
    count = eyes + counts[1] - first;
  }
  for (std::uint32_t l = 0; l < state_.model.lights.size(); ++l) light_rays(hits, l);
  sum_samples(t, index, eyes, view, pixels);
  return true;
}

bool split_renderer::render(const tile& t, runtime::buffer<View>& view,
                            runtime::buffer<texel>& pixels, std::map<std::string, double>& ms) {
  if (places(t) > capacity_) return false;
  done_.clear();
  const std::uint32_t samples = state_.model.samples * state_.model.samples;
  for (std::uint32_t k = 0; k < samples; ++k)
    if (!sample(t, k, view, pixels)) return false;
  done_.back().second.wait_and_throw();
  for (const auto& [name, done] : done_) ms[name] += done.milliseconds();
  return true;
}

}  // namespace facet::tracer
