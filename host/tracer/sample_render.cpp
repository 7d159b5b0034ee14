#include "tracer/sample_render.hpp"

#include <algorithm>

#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr const char* main_file = "render_samples.cl";

constexpr std::uint32_t list_group = 256;  ///< a power of 2

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
      mark_(program_.get_kernel("mark_groups")),
      list_(program_.get_kernel("list_groups")),
      trace_(program_.get_kernel("render_samples")),
      mean_(program_.get_kernel("mean_samples")),
      samples_(has_means() ? most_pixels_ * samples_of(s) : 1),
      marks_(1),
      groups_(1),
      untold_(1) {}

kernel_description sample_renderer::describe() const {
  return {runtime::expand(state_.kernels, main_file), program_.options(),
          trace_.work_group_size(state_.queue.get_device())};
}

bool sample_renderer::has_means() const { return state_.model.samples > 1; }

std::uint64_t sample_renderer::pixels_for(std::uint64_t pixels) const {
  if (!has_means()) return pixels;
  const runtime::device d = state_.queue.get_device();
  const std::uint64_t bytes =
      std::min(d.global_mem_size() / 8, std::uint64_t(d.max_mem_alloc_size()));
  return std::clamp<std::uint64_t>(bytes / sizeof(texel) / samples_of(state_), 1, pixels);
}

runtime::range<2> sample_renderer::group() const {
  return {state_.tuned.render_group_width, state_.tuned.render_group_height};
}

void sample_renderer::run(const std::function<void(runtime::handler&)>& group) {
  done_.push_back(state_.queue.submit(group));
}

runtime::nd_range<2> sample_renderer::all_samples(const tile& t) const {
  const std::uint32_t n = state_.model.samples;
  return padded(n * t.width(), n * t.height(), group());
}

/// To mark groups takes 0.1 ms on an H100. Where no more than four times what runs at once is
/// traced, or where two rays at most follow an eye ray, that is not gained.
bool sample_renderer::pays_to_list(const tile& t) const {
  constexpr std::uint64_t at_once = 1024;  // work-items of a compute unit, by their registers
  return state_.used.transparency && max_depth_ > 2 &&
         t.pixels() * samples_of(state_) >
             4 * at_once * state_.queue.get_device().max_compute_units();
}

void sample_renderer::mark(const tile& t, runtime::buffer<View>& view) {
  const runtime::range<2> all = all_samples(t).get_group_range();
  hold(marks_, all.size() / 32 + 1);
  run([&](runtime::handler& h) {
    const runtime::accessor marks{marks_, h, runtime::write_only};
    h.fill(marks, 0u);
  });
  run([&](runtime::handler& h) {
    std::uint32_t k = state_.set_picture(h, view);
    h.set_arg(k++, runtime::accessor{marks_, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{untold_, h, runtime::read_write});
    for (const std::size_t x :
         {std::size_t(t.left), std::size_t(t.top), group()[0], group()[1], all[0], all[1]})
      h.set_arg(k++, std::uint32_t(x));
    h.parallel_for(padded((all[0] + 1) * (all[1] + 1), state_.tuned.group), mark_);
  });
}

void sample_renderer::list(const tile& t) {
  const auto count = std::uint32_t(all_samples(t).get_group_range().size());
  hold(groups_, count);
  run([&](runtime::handler& h) {
    const runtime::accessor marks{marks_, h, runtime::read_only};
    const runtime::accessor groups{groups_, h, runtime::write_only};
    h.set_args(marks, groups, count, runtime::local_accessor<std::uint32_t>(list_group, h));
    h.parallel_for(padded(count, list_group), list_);
  });
}

void sample_renderer::trace(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& to,
                            bool is_listed) {
  run([&](runtime::handler& h) {
    std::uint32_t k = state_.set_picture(h, view);
    h.set_arg(k++, runtime::accessor{to, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{groups_, h, runtime::read_only});
    for (const std::uint32_t x : {std::uint32_t(is_listed), t.left, t.top, t.right, t.bottom})
      h.set_arg(k++, x);
    h.parallel_for(all_samples(t), trace_);
  });
}

void sample_renderer::mean(const tile& t, runtime::buffer<View>& view,
                           runtime::buffer<texel>& pixels) {
  run([&](runtime::handler& h) {
    const runtime::accessor from{view, h, runtime::read_only};
    const runtime::accessor samples{samples_, h, runtime::read_only};
    const runtime::accessor to{pixels, h, runtime::read_write};
    h.set_args(from, samples, to, t.left, t.top, t.right, t.bottom);
    h.parallel_for(padded(t.width(), t.height(), group()), mean_);
  });
}

double sample_renderer::render(const tile& t, runtime::buffer<View>& view,
                               runtime::buffer<texel>& pixels) {
  done_.clear();
  const bool is_listed = state_.chosen.glass_first.value_or(pays_to_list(t));
  if (is_listed) {
    mark(t, view);
    list(t);
  }
  trace(t, view, has_means() ? samples_ : pixels, is_listed);
  if (has_means()) mean(t, view, pixels);
  done_.back().wait_and_throw();
  double ms = 0;
  for (const runtime::event& e : done_) ms += e.milliseconds();
  return ms;
}

}  // namespace facet::tracer
