#include "runtime/context.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "runtime/context_state.hpp"

namespace facet::runtime {

cl::CommandQueue detail::context_state::transfers(const device& d) {
  const std::lock_guard lock(mutex_);
  cl::CommandQueue& q = transfers_[d.get()];
  if (!q()) q = call([&] { return cl::CommandQueue(context, cl::Device(d.get(), true)); });
  return q;
}

context::context(const std::vector<device>& devices)
    : state_(std::make_shared<detail::context_state>()) {
  if (devices.empty()) throw exception(errc::invalid, "a context needs at least one device");
  state_->devices = devices;
  std::vector<cl::Device> list;
  list.reserve(devices.size());
  for (const device& d : devices) list.emplace_back(d.get(), true);
  state_->context = detail::call([&] { return cl::Context(list); });
}

context context::of(const device& d) {
  static std::mutex mutex;
  static std::map<native::device, std::weak_ptr<detail::context_state>> shared;
  const std::lock_guard lock(mutex);
  std::weak_ptr<detail::context_state>& known = shared[d.get()];
  if (auto state = known.lock()) return context(std::move(state));
  context made(d);
  known = made.state_;
  return made;
}

std::vector<device> context::get_devices() const { return state_->devices; }
std::uint64_t context::memory_in_use() const noexcept { return state_->memory.now(); }
std::uint64_t context::peak_memory() const noexcept { return state_->memory.most(); }
void context::restart_peak() noexcept { state_->memory.restart(); }

native::context context::get() const noexcept { return state_->context(); }

}  // namespace facet::runtime
