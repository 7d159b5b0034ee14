#include "tracer/sample_render.hpp"

#include <algorithm>

#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr const char* main_file = "render_samples.cl";

std::uint64_t samples_of(const device_scene::state& s) {
  return std::uint64_t(s.model.samples) * s.model.samples;
}

}  // namespace

sample_renderer::sample_renderer(device_scene::state& s, std::uint32_t max_depth,
                                 std::uint64_t pixels)
    : state_(s),
      max_depth_(max_depth),
      most_pixels_(pixels_for(pixels)),
      program_(s.compiled_to_render(main_file, max_depth)),
      trace_(program_.get_kernel("render_samples")),
      mean_(program_.get_kernel("mean_samples")),
      samples_(most_pixels_ * samples_of(s)) {}

kernel_description sample_renderer::describe() const {
  return {runtime::expand(state_.kernels, main_file), program_.options(),
          trace_.work_group_size(state_.queue.get_device())};
}

std::uint64_t sample_renderer::pixels_for(std::uint64_t pixels) const {
  const runtime::device d = state_.queue.get_device();
  const std::uint64_t bytes =
      std::min(d.global_mem_size() / 8, std::uint64_t(d.max_mem_alloc_size()));
  return std::clamp<std::uint64_t>(bytes / sizeof(texel) / samples_of(state_), 1, pixels);
}

double sample_renderer::render(const tile& t, runtime::buffer<View>& view,
                               runtime::buffer<texel>& pixels) {
  const runtime::range<2> group(state_.tuned.render_group_width, state_.tuned.render_group_height);
  const std::uint32_t n = state_.model.samples;
  const runtime::event traced = state_.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = state_.set_picture(h, view);
    h.set_arg(k++, runtime::accessor{samples_, h, runtime::write_only});
    for (const std::uint32_t x : {t.left, t.top, t.right, t.bottom}) h.set_arg(k++, x);
    h.parallel_for(padded(n * t.width(), n * t.height(), group), trace_);
  });
  const runtime::event summed = state_.queue.submit([&](runtime::handler& h) {
    const runtime::accessor from{view, h, runtime::read_only};
    const runtime::accessor samples{samples_, h, runtime::read_only};
    const runtime::accessor to{pixels, h, runtime::read_write};
    h.set_args(from, samples, to, t.left, t.top, t.right, t.bottom);
    h.parallel_for(padded(t.width(), t.height(), group), mean_);
  });
  summed.wait_and_throw();
  return traced.milliseconds() + summed.milliseconds();
}

}  // namespace facet::tracer
