// Rays of a buffer on the device, traced by one launch at a time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tracer/state.hpp"

namespace facet::tracer {

class ray_batch {
 public:
  /// Rays go to the device. At least one; the scene must outlive this.
  ray_batch(device_scene::state& s, std::span<const ray> rays, bool any);

  /// What only a first launch costs is paid here, before anything is timed: memory that nothing has
  /// touched is filled, and one group pays for moving the rays, and for compiling, which PoCL does
  /// anew for each work-group size.
  void warm_up();

  /// Whether a warp's work-items take new rays while others are on their way (cl/refill.h), as the
  /// scene's options say, or where they leave it open as a sample of the rays does.
  bool chooses_refill();

  /// All rays once.
  runtime::event trace(bool refilled);

  /// Waits for them.
  std::vector<hit> hits() const;

 private:
  runtime::event launch(std::uint32_t count);
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
  runtime::buffer<std::uint32_t> counts_;     ///< of cl/refill.h
};

}  // namespace facet::tracer
