// Rays in, hits out: device_scene::trace.
#include <algorithm>
#include <limits>

#include "tracer/ray_batch.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {

std::vector<hit> device_scene::trace(std::span<const ray> rays, bool any, unsigned repeat,
                                     statistics* stats) {
  state& s = *state_;
  if (rays.size() >= std::numeric_limits<std::uint32_t>::max())
    throw runtime::exception(runtime::errc::invalid, std::to_string(rays.size()) +
                                                         " rays in one call; at most 2^32 - 2 are "
                                                         "allowed: trace them in parts");
  const bool streamed = chooses_streams(s, rays.size());
  streamed ? s.streamed_kernel(any) : s.trace_kernel(any);  // compiled before anything is timed
  if (stats) {
    *stats = {};
    stats->rays = rays.size();
    stats->group_width = s.in_packets ? s.tuned.packet_group : s.tuned.group;
    stats->group_height = 1;
  }
  if (rays.empty()) {
    if (stats) s.describe(*stats);
    return {};
  }

  const auto start = clock::now();
  ray_batch batch(s, rays, any);
  batch.warm_up(streamed);
  const bool refilled = !streamed && batch.chooses_refill();
  for (unsigned k = 0; k < std::max(1u, repeat); ++k) {
    s.clear_faults();
    const runtime::event done = batch.trace(streamed, refilled);
    done.wait_and_throw();
    if (stats) stats->kernel_ms.push_back(done.milliseconds());
  }
  std::vector<hit> hits = batch.hits();
  if (stats) {
    s.describe(*stats);
    stats->is_refilled = refilled;
    stats->is_streamed = streamed;
    if (streamed) stats->group_width = 1;
    stats->refused = s.read_faults().refused;
    stats->wall_ms = milliseconds_since(start);
  }
  return hits;
}

}  // namespace facet::tracer
