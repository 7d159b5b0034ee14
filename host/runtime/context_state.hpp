// Internal: what a context holds.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "runtime/device.hpp"
#include "runtime/opencl.hpp"

namespace facet::runtime::detail {

/// Bytes of buffers and images that are on a context's devices, and the most since the last
/// restart.
class memory_count {
 public:
  void add(std::uint64_t bytes) {
    const std::uint64_t now = now_ += bytes;
    for (std::uint64_t most = most_; most < now && !most_.compare_exchange_weak(most, now);) {
    }
  }
  void remove(std::uint64_t bytes) { now_ -= bytes; }
  void restart() { most_ = now_.load(); }
  std::uint64_t now() const { return now_; }
  std::uint64_t most() const { return most_; }

 private:
  std::atomic<std::uint64_t> now_ = 0, most_ = 0;
};

struct context_state {
  std::vector<device> devices;
  cl::Context context;
  memory_count memory{};

  /// An in-order queue for the host's own blocking transfers, made on first use. A command enters
  /// it only when all that it depends on has ended, so that nobody waits for commands of others.
  cl::CommandQueue transfers(const device& d);

 private:
  std::mutex mutex_;
  std::map<native::device, cl::CommandQueue> transfers_;
};

}  // namespace facet::runtime::detail
