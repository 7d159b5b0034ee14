#include "tracer/ray_batch.hpp"

#include <algorithm>

#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

static_assert(sizeof(ray) == sizeof(Ray), "rays are copied as they are");

// Of a compute unit, with the registers that the kernels take.
constexpr std::size_t resident_of_unit = 1024;

// A sample takes a few microseconds; a batch that small is not worth it.
constexpr std::size_t least_of_resident = 2;
constexpr std::uint32_t warps_sampled = 256, warp = 32;

// By steps (cl/search_narrow.h). On an H100 closest hits by refilled warps are 5 to 32% faster
// where 0.27 to 0.40 of the lanes are at work otherwise, and 11 to 13% slower where 0.67 or 0.76
// are. Any hits are as fast or up to 14% faster.
constexpr double lanes_enough = 0.55;

// A stream of few rays is soon as slow as the rays by themselves, and a compute unit's last one
// leaves the others without work.
constexpr std::uint32_t least_stream = 512, streams_of_unit = 8;

}  // namespace

bool chooses_streams(const device_scene::state& s, std::size_t count) {
  const std::size_t many =
      std::size_t(least_stream) * streams_of_unit * s.queue.get_device().max_compute_units();
  return s.streams && (s.chosen.streams == stream_kind::on || count >= many);
}

ray_batch::ray_batch(device_scene::state& s, std::span<const ray> rays, bool any)
    : state_(s),
      any_(any),
      with_instances_(s.used.instances),
      count_(std::uint32_t(rays.size())),
      each_(s.in_packets ? FACET_PACKET : 1),
      group_(s.in_packets ? s.tuned.packet_group : s.tuned.group),
      in_(reinterpret_cast<const Ray*>(rays.data()), rays.size()),
      out_(rays.size()),
      instances_(with_instances_ ? rays.size() : 1),
      counts_(2) {}

std::uint32_t ray_batch::set_rays(runtime::handler& h, std::uint32_t k) {
  h.set_arg(k++, runtime::accessor{in_, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{out_, h, runtime::read_write});
  h.set_arg(k++, runtime::accessor{instances_, h, runtime::write_only});
  return k;
}

runtime::event ray_batch::launch(std::uint32_t count) {
  return state_.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = set_rays(h, state_.set_geometry(h));
    h.set_arg(k++, count);
    h.parallel_for(padded((count + each_ - 1) / each_, group_), state_.trace_kernel(any_));
  });
}

void ray_batch::clear_counts() {
  state_.queue.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{counts_, h, runtime::write_only}, 0u);
  });
}

std::uint32_t ray_batch::rays_of_stream() const {
  const std::uint32_t units = state_.queue.get_device().max_compute_units();
  const std::uint32_t even = count_ / (streams_of_unit * units) / FACET_PACKET * FACET_PACKET;
  return std::clamp(even, least_stream, FACET_STREAM);
}

runtime::event ray_batch::launch_streams(std::uint32_t count) {
  const std::uint32_t units = state_.queue.get_device().max_compute_units();
  if (!streams_) streams_.emplace(units);
  clear_counts();
  return state_.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = set_rays(h, state_.set_geometry(h));
    h.set_arg(k++, count);
    h.set_arg(k++, runtime::accessor{*streams_, h, runtime::read_write});
    h.set_arg(k++, runtime::accessor{counts_, h, runtime::read_write});
    h.set_arg(k++, rays_of_stream());
    h.parallel_for(padded(units, 1), state_.streamed_kernel(any_));
  });
}

void ray_batch::warm_up(bool streamed) {
  state_.queue.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{out_, h, runtime::write_only}, Hit{});
  });
  (streamed ? launch_streams(std::min(count_, least_stream))
            : launch(std::min(count_, each_ * group_)))
      .wait_and_throw();
}

bool ray_batch::chooses_refill() {
  if (state_.chosen.refill != refill_kind::automatic)
    return state_.chosen.refill == refill_kind::on;
  return state_.refills && count_ >= least_of_resident * resident_items() &&
         (any_ || lanes_in_use() < lanes_enough);
}

double ray_batch::lanes_in_use() {
  const std::uint32_t apart = count_ / warps_sampled;
  clear_counts();
  state_.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = state_.set_geometry(h);
    h.set_arg(k++, runtime::accessor{in_, h, runtime::read_only});
    h.set_arg(k++, apart);
    h.set_arg(k++, runtime::accessor{counts_, h, runtime::read_write});
    h.parallel_for(padded(warps_sampled * warp, group_), state_.refilled_kernel("sample_closest"));
  });
  const runtime::host_accessor steps{counts_, runtime::read_only};
  return steps[1] == 0 ? 1 : double(steps[0]) / steps[1];
}

std::size_t ray_batch::resident_items() const {
  return resident_of_unit * state_.queue.get_device().max_compute_units();
}

runtime::event ray_batch::trace(bool streamed, bool refilled) {
  if (streamed) return launch_streams(count_);
  if (!refilled) return launch(count_);
  clear_counts();
  return state_.queue.submit([&](runtime::handler& h) {
    std::uint32_t k = set_rays(h, state_.set_geometry(h));
    h.set_arg(k++, count_);
    h.set_arg(k++, runtime::accessor{counts_, h, runtime::read_write});
    h.parallel_for(padded(std::min<std::size_t>(count_, resident_items()), group_),
                   state_.refilled_kernel(any_ ? "trace_any" : "trace_closest"));
  });
}

std::vector<hit> ray_batch::hits() const {
  const runtime::host_accessor found{out_, runtime::read_only};
  const runtime::host_accessor where{instances_, runtime::read_only};
  std::vector<hit> hits(count_);
  for (std::size_t i = 0; i < count_; ++i) {
    const Hit& h = found[i];
    const std::uint32_t instance = h.triangle == miss ? miss : with_instances_ ? where[i] : 0;
    hits[i] = {h.t, h.u, h.v, instance, h.triangle};
  }
  return hits;
}

}  // namespace facet::tracer
