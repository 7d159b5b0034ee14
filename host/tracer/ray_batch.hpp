// Rays of a buffer on the device, traced by one launch at a time.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tracer/state.hpp"

namespace facet::tracer {

/// Whether so many rays, those that do not stay close, go through the tree in lists
/// (cl/search_stream.h), as the scene's options say, or where they leave it open if there are many.
bool chooses_streams(const device_scene::state& s, std::size_t count);

class ray_batch {
 public:
  /// Rays go to the device. At least one; the scene must outlive this.
  ray_batch(device_scene::state& s, std::span<const ray> rays, bool any);

  /// What only a first launch costs is paid here, before anything is timed: memory that nothing has
  /// touched is filled, and a few rays pay for moving all, and for compiling, which PoCL does
  /// anew for each work-group size.
  void warm_up(bool streamed);

  /// Whether a warp's work-items take new rays while others are on their way (cl/refill.h), as the
  /// scene's options say, or where they leave it open as a sample of the rays does.
  bool chooses_refill();

  /// All rays once, at most one of both.
  runtime::event trace(bool streamed, bool refilled);

  /// Waits for them.
  std::vector<hit> hits() const;

 private:
  runtime::event launch(std::uint32_t count);
  runtime::event launch_streams(std::uint32_t count);
  /// Rays that a work-item takes at once as a stream.
  std::uint32_t rays_of_stream() const;
  /// Work-items that the device has room for.
  std::size_t resident_items() const;
  void clear_counts();
  /// Of the work-items of a warp the share that is at work if each has one ray, by a sample.
  double lanes_in_use();
  std::uint32_t set_rays(runtime::handler& h, std::uint32_t k);

  device_scene::state& state_;
  const bool any_, with_instances_;
  const std::uint32_t count_;
  const std::uint32_t each_, group_;  ///< rays a work-item, work-items a group
  runtime::buffer<Ray> in_;
  runtime::buffer<Hit> out_;
  runtime::buffer<std::uint32_t> instances_;  ///< one if the scene has none
  runtime::buffer<std::uint32_t> counts_;     ///< of cl/refill.h; the first, of cl/trace_streams.cl
  std::optional<runtime::buffer<Stream>> streams_;  ///< one a compute unit
};

}  // namespace facet::tracer
