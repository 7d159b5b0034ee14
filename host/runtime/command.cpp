#include "runtime/command.hpp"

#include <algorithm>
#include <string>

namespace facet::runtime::detail {

void add_once(std::vector<command>& to, const command& c) {
  const auto same = [&](const command& other) { return other.event() == c.event(); };
  if (std::none_of(to.begin(), to.end(), same)) to.push_back(c);
}

void hazards::collect(access_mode mode, std::vector<command>& to) const {
  if (writes(mode) && !reads_.empty()) {
    for (const command& c : reads_) add_once(to, c);
  } else if (last_write_) {
    add_once(to, *last_write_);
  }
}

void hazards::record(access_mode mode, const command& c) {
  if (writes(mode)) {
    last_write_ = c;
    reads_.clear();
    return;
  }
  // In an in-order queue the end of a later read implies that of an earlier one.
  const auto replaced = [&](const command& r) { return r.in_order && r.queue() == c.queue(); };
  std::erase_if(reads_, replaced);
  if (reads_.size() >= reads_limit_) forget_ended_reads();
  reads_.push_back(c);
}

void hazards::forget_ended_reads() {
  // With all reads gone, a write waits for the last write, which ended before them.
  std::erase_if(reads_, [](const command& r) { return status_of(r.event) == CL_COMPLETE; });
  reads_limit_ = std::max<std::size_t>(16, 2 * reads_.size());
}

cl_int status_of(const cl::Event& e) {
  return call([&] { return e.getInfo<CL_EVENT_COMMAND_EXECUTION_STATUS>(); });
}

void wait_for(const command& c) {
  if (c.queue()) call([&] { return c.queue.flush(); });
  const cl_event handle = c.event();
  const cl_int result = clWaitForEvents(1, &handle);
  if (result != CL_SUCCESS && status_of(c.event) >= 0) throw failed_call("clWaitForEvents", result);
}

std::string failure_text(cl_int status) {
  if (status == -1) return "the driver gives no reason (-1)";
  return std::string(code_name(status)) + " (" + std::to_string(status) + ")";
}

exception failed_dependency(cl_int status) {
  return {errc::event, "a command that this one depends on failed: " + failure_text(status),
          status};
}

void wait_for_success(const std::vector<command>& commands) {
  for (const command& c : commands) wait_for(c);
  for (const command& c : commands)
    if (const cl_int status = status_of(c.event); status < 0) throw failed_dependency(status);
}

}  // namespace facet::runtime::detail
