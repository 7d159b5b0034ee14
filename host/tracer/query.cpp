// Rays in, hits out: device_scene::trace.
#include <limits>

#include "tracer/launch.hpp"
#include "tracer/state.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {
namespace {

static_assert(sizeof(ray) == sizeof(Ray), "rays are copied as they are");

}  // namespace

std::vector<hit> device_scene::trace(std::span<const ray> rays, bool any, unsigned repeat,
                                     statistics* stats) {
  state& s = *state_;
  if (rays.size() >= std::numeric_limits<std::uint32_t>::max())
    throw runtime::exception(runtime::errc::invalid, std::to_string(rays.size()) +
                                                         " rays in one call; at most 2^32 - 2 are "
                                                         "allowed: trace them in parts");
  runtime::kernel kernel = s.trace_kernel(any);
  std::vector<hit> hits(rays.size());
  if (stats) {
    *stats = {};
    stats->rays = rays.size();
    stats->group_width = s.in_packets ? s.tuned.packet_group : s.tuned.group;
    stats->group_height = 1;
    s.describe(*stats);
  }
  if (rays.empty()) return hits;

  const auto start = clock::now();
  const bool with_instances = s.used.instances;
  const auto count = std::uint32_t(rays.size());
  const std::uint32_t each = s.in_packets ? FACET_PACKET : 1,
                      group = s.in_packets ? s.tuned.packet_group : s.tuned.group;
  runtime::buffer<Ray> in(reinterpret_cast<const Ray*>(rays.data()), rays.size());
  runtime::buffer<Hit> out(rays.size());
  runtime::buffer<std::uint32_t> instances(with_instances ? rays.size() : 1);
  const auto launch = [&](std::uint32_t size) {
    return s.queue.submit([&](runtime::handler& h) {
      std::uint32_t k = s.set_geometry(h);
      h.set_arg(k++, runtime::accessor{in, h, runtime::read_only});
      h.set_arg(k++, runtime::accessor{out, h, runtime::read_write});
      h.set_arg(k++, runtime::accessor{instances, h, runtime::write_only});
      h.set_arg(k++, size);
      h.parallel_for(padded((size + each - 1) / each, group), kernel);
    });
  };
  // What only a first launch costs is paid before anything is timed: memory that nothing has
  // touched is filled, and one group pays for moving the rays, and for compiling, which PoCL does
  // anew for each work-group size.
  s.queue.submit([&](runtime::handler& h) {
    const runtime::accessor all{out, h, runtime::write_only};
    h.fill(all, Hit{});
  });
  launch(std::min(count, each * group)).wait_and_throw();
  for (unsigned k = 0; k < std::max(1u, repeat); ++k) {
    s.clear_faults();
    const runtime::event done = launch(count);
    done.wait_and_throw();
    if (stats) stats->kernel_ms.push_back(done.milliseconds());
  }
  const runtime::host_accessor found{out, runtime::read_only};
  const runtime::host_accessor where{instances, runtime::read_only};
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Hit& h = found[i];
    const std::uint32_t instance = h.triangle == miss ? miss : with_instances ? where[i] : 0;
    hits[i] = {h.t, h.u, h.v, instance, h.triangle};
  }
  if (stats) {
    stats->refused = s.read_faults().refused;
    stats->wall_ms = milliseconds_since(start);
  }
  return hits;
}

}  // namespace facet::tracer
