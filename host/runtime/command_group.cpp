#include "runtime/command_group.hpp"

#include <algorithm>
#include <mutex>

#include "runtime/event_state.hpp"
#include "runtime/launch.hpp"

namespace facet::runtime::detail {
namespace {

access_mode both(access_mode a, access_mode b) { return a == b ? a : access_mode::read_write; }

/// Locks every memory of the group, by address, so that two groups cannot block each other.
std::vector<std::unique_lock<std::mutex>> lock_all(const std::vector<requirement>& requirements) {
  std::vector<memory*> objects;
  objects.reserve(requirements.size());
  for (const requirement& r : requirements) objects.push_back(r.object.get());
  std::sort(objects.begin(), objects.end(), std::less<>());
  std::vector<std::unique_lock<std::mutex>> locks;
  locks.reserve(objects.size());
  for (memory* m : objects) locks.emplace_back(m->mutex);
  return locks;
}

}  // namespace

void command_group::require(const std::shared_ptr<memory>& m, access_mode mode, bool discard) {
  for (requirement& r : requirements) {
    if (r.object != m) continue;
    r.mode = both(r.mode, mode);
    r.discard = r.discard && discard;
    return;
  }
  requirements.push_back({m, mode, discard});
}

bool command_group::requires_memory(const memory& m) const {
  return std::any_of(requirements.begin(), requirements.end(),
                     [&](const requirement& r) { return r.object.get() == &m; });
}

void command_group::act(description called, action a) {
  if (what_)
    throw exception(errc::invalid, "a command group has one action: this one already has " +
                                       *what_ + " and was given " + *called);
  what_ = std::move(called);
  action_ = std::move(a);
}

std::vector<cl::Event> command_group::wait_list(const std::vector<command>& behind) const {
  std::vector<cl::Event> waits;
  for (const command& c : behind) {
    const bool foreign = c.queue() != queue->queue();
    if (!foreign && queue->in_order) continue;
    const cl_int status = status_of(c.event);
    if (status == CL_COMPLETE) continue;
    if (status < 0) throw failed_dependency(status);
    // Another queue's commands start for sure only once it is flushed.
    if (foreign && c.queue()) call([&] { return c.queue.flush(); });
    waits.push_back(c.event);
  }
  return waits;
}

event command_group::finish() {
  if (launched) check_launch(*launched, shape, arguments, queue->target);
  const auto locks = lock_all(requirements);
  std::vector<command> behind = after;
  for (const requirement& r : requirements) {
    r.object->prepare(queue, r.mode, r.discard);
    r.object->collect(r.mode, behind);
  }
  const std::vector<cl::Event> waits = wait_list(behind);
  auto state = std::make_shared<event_state>();
  state->of = {{}, queue->queue, queue->in_order};
  state->owner = queue;
  if (action_) {
    call([&] { action_(queue->queue, waits, state->of.event); }, *what_);
  } else {
    // A marker behind nothing would wait for all commands of an out-of-order queue.
    if (waits.empty() && !queue->in_order) return event();
    call([&] { return queue->queue.enqueueMarkerWithWaitList(&waits, &state->of.event); });
  }
  for (const requirement& r : requirements) r.object->record(r.mode, state->of);
  queue->watch(state->of.event, what_ ? what_ : std::make_shared<const std::string>("a marker"));
  state->behind = std::move(behind);
  return event(std::move(state));
}

}  // namespace facet::runtime::detail
