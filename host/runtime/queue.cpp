#include "runtime/queue.hpp"

#include <algorithm>

#include "runtime/command_group.hpp"
#include "runtime/handler.hpp"
#include "runtime/queue_state.hpp"

namespace facet::runtime {
namespace detail {

queue_state::queue_state(std::shared_ptr<context_state> in, const device& on, bool ordered,
                         bool profiled, async_handler errors)
    : context(std::move(in)),
      target(on),
      in_order(ordered),
      profiling(profiled),
      handler(std::move(errors)),
      queue(call([&] {
        const cl_command_queue_properties bits =
            (ordered ? 0u : CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) |
            (profiled ? CL_QUEUE_PROFILING_ENABLE : 0u);
        return cl::CommandQueue(context->context, cl::Device(on.get(), true), bits);
      })) {}

void queue_state::wait() {
  const cl_int result = clFinish(queue());
  const std::lock_guard lock(mutex_);
  harvest();
  // Some drivers report a failed command here too: its own message says more.
  if (result != CL_SUCCESS && failures_.empty())
    failures_.push_back(std::make_exception_ptr(failed_call("clFinish", result)));
}

void queue_state::watch(const cl::Event& e, description what) {
  const std::lock_guard lock(mutex_);
  if (watched_.size() >= watched_limit_) {
    harvest();
    watched_limit_ = std::max<std::size_t>(64, 2 * watched_.size());
  }
  watched_.push_back({e, std::move(what)});
}

void queue_state::harvest() {
  std::erase_if(watched_, [&](const watched& w) {
    const cl_int status = status_of(w.event);
    if (status < 0)
      failures_.push_back(std::make_exception_ptr(
          exception(status == -1 ? errc::runtime : errc_of(status),
                    *w.what + " failed after it was submitted: " + failure_text(status), status)));
    return status <= CL_COMPLETE;
  });
}

void queue_state::report(std::exception_ptr failure) noexcept {
  try {
    const std::lock_guard lock(mutex_);
    failures_.push_back(std::move(failure));
  } catch (...) {
    // No memory for the message: this is called by destructors.
  }
}

void queue_state::throw_asynchronous() {
  exception_list failures;
  {
    const std::lock_guard lock(mutex_);
    harvest();
    failures.swap(failures_);
  }
  if (failures.empty()) return;
  if (!handler) std::rethrow_exception(failures.front());
  handler(std::move(failures));
}

}  // namespace detail

queue::queue(const device& d, queue_properties properties, async_handler errors)
    : queue(context::of(d), d, properties, std::move(errors)) {}

queue::queue(const context& c, const device& d, queue_properties properties, async_handler errors) {
  const std::vector<device>& devices = c.state()->devices;
  if (std::find(devices.begin(), devices.end(), d) == devices.end())
    throw exception(errc::invalid, "the device " + d.name() + " is not in the context, which has " +
                                       list_devices(devices));
  const bool in_order = !properties.out_of_order || !d.has_out_of_order_queues();
  state_ = std::make_shared<detail::queue_state>(c.state(), d, in_order, properties.profiling,
                                                 std::move(errors));
}

event queue::submit(const std::function<void(handler&)>& group) {
  detail::command_group g(state_);
  handler h(g);
  group(h);
  return g.finish();
}

void queue::wait() { state_->wait(); }

void queue::wait_and_throw() {
  wait();
  state_->throw_asynchronous();
}

void queue::throw_asynchronous() { state_->throw_asynchronous(); }

bool queue::is_in_order() const noexcept { return state_->in_order; }
bool queue::has_profiling() const noexcept { return state_->profiling; }
device queue::get_device() const { return state_->target; }
context queue::get_context() const { return context(state_->context); }
native::queue queue::get() const noexcept { return state_->queue(); }

}  // namespace facet::runtime
