#include "runtime/event.hpp"

#include "runtime/event_state.hpp"

namespace facet::runtime {

event event::from_native(native::event handle) {
  auto state = std::make_shared<detail::event_state>();
  state->of.event = cl::Event(handle, true);
  return event(std::move(state));
}

void event::wait() const {
  if (state_) detail::wait_for(state_->of);
}

void event::wait(const std::vector<event>& events) {
  for (const event& e : events) e.wait();
}

void event::wait_and_throw() const {
  if (!state_) return;
  wait();
  if (state_->owner)
    state_->owner->throw_asynchronous();
  else
    detail::wait_for_success({state_->of});
}

std::vector<event> event::get_wait_list() const {
  std::vector<event> list;
  if (!state_) return list;
  for (const detail::command& c : state_->behind)
    list.emplace_back(
        std::make_shared<detail::event_state>(detail::event_state{c, state_->owner, {}}));
  return list;
}

info::event_command_status event::status() const {
  if (!state_) return info::event_command_status::complete;
  // Without a flush a command that nobody waits for may never start.
  if (state_->of.queue()) detail::call([&] { return state_->of.queue.flush(); });
  const cl_int status = detail::status_of(state_->of.event);
  if (status <= CL_COMPLETE) return info::event_command_status::complete;
  return status == CL_RUNNING ? info::event_command_status::running
                              : info::event_command_status::submitted;
}

std::uint64_t event::profiling(info::event_profiling what) const {
  if (!state_ || (state_->owner && !state_->owner->profiling))
    throw exception(errc::profiling,
                    state_ ? "the event's queue was made without profiling: make it with "
                             "queue_properties{.profiling = true}"
                           : "an event of no command has no times");
  wait();
  return detail::call([&]() -> std::uint64_t {
    switch (what) {
      case info::event_profiling::command_submit:
        return state_->of.event.getProfilingInfo<CL_PROFILING_COMMAND_SUBMIT>();
      case info::event_profiling::command_start:
        return state_->of.event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
      case info::event_profiling::command_end:
        break;
    }
    return state_->of.event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
  });
}

double event::milliseconds() const {
  const std::uint64_t end = profiling(info::event_profiling::command_end);
  return double(end - profiling(info::event_profiling::command_start)) * 1e-6;
}

native::event event::get() const noexcept { return state_ ? state_->of.event() : nullptr; }

}  // namespace facet::runtime
