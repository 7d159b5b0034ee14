// A command that was submitted (SYCL 2020, section 4.6.6).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/native.hpp"

namespace facet::runtime {

namespace info {
enum class event { command_execution_status };
enum class event_command_status { submitted, running, complete };
/// Device time in nanoseconds: handed to the device, started, ended.
enum class event_profiling { command_submit, command_start, command_end };
}  // namespace info

namespace detail {
struct event_state;
}

/// A cheap handle: copies are the same event. One made by `event()` is complete.
class event {
 public:
  event() = default;
  explicit event(std::shared_ptr<const detail::event_state> state) : state_(std::move(state)) {}

  /// An event that the caller made by OpenCL (a user event, say): for handler::depends_on. Shares
  /// ownership of `handle`.
  static event from_native(native::event handle);

  /// Blocks until the command ended. A command's own failure is kept for wait_and_throw().
  void wait() const;
  static void wait(const std::vector<event>& events);
  /// Blocks, then hands the failures of the queue's ended commands to its async_handler, or throws
  /// the first of them if it has none.
  void wait_and_throw() const;

  /// The commands that this one was found to depend on, as it was submitted: those of its own
  /// in-order queue too, which need no entry in OpenCL's wait list. Their own lists are empty.
  std::vector<event> get_wait_list() const;

  /// A failed command counts as complete.
  template <info::event What>
  info::event_command_status get_info() const {
    return status();
  }

  /// Waits for the command's end. Throws errc::profiling if the queue was made without profiling.
  template <info::event_profiling What>
  std::uint64_t get_profiling_info() const {
    return profiling(What);
  }

  /// From start to end on the device. Throws as get_profiling_info.
  double milliseconds() const;

  native::event get() const noexcept;
  const std::shared_ptr<const detail::event_state>& state() const noexcept { return state_; }
  friend bool operator==(const event&, const event&) = default;

 private:
  info::event_command_status status() const;
  std::uint64_t profiling(info::event_profiling what) const;

  std::shared_ptr<const detail::event_state> state_;
};

}  // namespace facet::runtime
