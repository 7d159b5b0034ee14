// What devices share memory and programs through (SYCL 2020, section 4.6.3).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/device.hpp"
#include "runtime/native.hpp"

namespace facet::runtime {

namespace detail {
struct context_state;
}

/// A cheap handle: copies are the same context.
class context {
 public:
  /// A new context of its own. Devices must be of one platform. Throws errc::invalid for none.
  explicit context(const device& d) : context(std::vector<device>{d}) {}
  explicit context(const std::vector<device>& devices);
  explicit context(std::shared_ptr<detail::context_state> state) : state_(std::move(state)) {}

  /// The context that all queues made from this device alone share while one of them lives, so
  /// that buffers can go from queue to queue.
  static context of(const device& d);

  std::vector<device> get_devices() const;
  platform get_platform() const { return get_devices().front().get_platform(); }

  /// Bytes of all buffers and images that a command has put on the devices and that still live; and
  /// the most that they have been, since restart_peak() if it was called.
  std::uint64_t memory_in_use() const noexcept;
  std::uint64_t peak_memory() const noexcept;
  /// From now on: peak_memory() is memory_in_use().
  void restart_peak() noexcept;

  native::context get() const noexcept;
  friend bool operator==(const context&, const context&) = default;

  const std::shared_ptr<detail::context_state>& state() const noexcept { return state_; }

 private:
  std::shared_ptr<detail::context_state> state_;
};

}  // namespace facet::runtime
