// Internal: what a context holds.
#pragma once

#include <map>
#include <mutex>
#include <vector>

#include "runtime/device.hpp"
#include "runtime/opencl.hpp"

namespace facet::runtime::detail {

struct context_state {
  std::vector<device> devices;
  cl::Context context;

  /// An in-order queue for the host's own blocking transfers, made on first use. A command enters
  /// it only when all that it depends on has ended, so that nobody waits for commands of others.
  cl::CommandQueue transfers(const device& d);

 private:
  std::mutex mutex_;
  std::map<native::device, cl::CommandQueue> transfers_;
};

}  // namespace facet::runtime::detail
