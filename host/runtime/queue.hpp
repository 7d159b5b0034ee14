// Where command groups are submitted to one device (SYCL 2020, section 4.6.5).
#pragma once

#include <functional>
#include <memory>

#include "runtime/context.hpp"
#include "runtime/device.hpp"
#include "runtime/error.hpp"
#include "runtime/event.hpp"

namespace facet::runtime {

class handler;

namespace detail {
class queue_state;
}

struct queue_properties {
  /// Commands without a dependency between them may run in any order. Unlike SYCL's, a queue is in
  /// order unless asked: dependencies are found either way, and drivers launch faster in order.
  bool out_of_order = false;
  bool profiling = true;
};

/// A cheap handle: copies are the same queue. All members may be called from several threads.
class queue {
 public:
  /// In the context that queues of this device share (context::of).
  explicit queue(const device& d, queue_properties properties = {}, async_handler errors = {});
  /// Throws errc::invalid if the device is not one of the context's.
  queue(const context& c, const device& d, queue_properties properties = {},
        async_handler errors = {});

  /// Runs `group` at once; it names what it reads and writes by accessors and asks for one action.
  /// The action is enqueued behind the commands that it depends on; this does not wait for them.
  /// A group with no action gives an event that completes when what it depends on has.
  event submit(const std::function<void(handler&)>& group);

  /// Blocks until all commands have ended. Failures are kept for wait_and_throw().
  void wait();
  /// Blocks, then does throw_asynchronous().
  void wait_and_throw();
  /// Hands the failures of ended commands to the async_handler; with none, throws the first.
  void throw_asynchronous();

  /// False only if out of order was asked for and the device can do it.
  bool is_in_order() const noexcept;
  bool has_profiling() const noexcept;
  device get_device() const;
  context get_context() const;

  native::queue get() const noexcept;
  friend bool operator==(const queue&, const queue&) = default;

 private:
  std::shared_ptr<detail::queue_state> state_;
};

}  // namespace facet::runtime
