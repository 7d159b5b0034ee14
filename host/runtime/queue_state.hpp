// Internal: what a queue holds, and the failures of its commands.
#pragma once

#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/context_state.hpp"
#include "runtime/error.hpp"

namespace facet::runtime::detail {

/// What a command is called in a message.
using description = std::shared_ptr<const std::string>;

class queue_state {
 public:
  queue_state(std::shared_ptr<context_state> in, const device& on, bool ordered, bool profiled,
              async_handler errors);

  const std::shared_ptr<context_state> context;
  const device target;
  const bool in_order, profiling;
  const async_handler handler;
  const cl::CommandQueue queue;

  /// Blocks until all commands ended; what failed is kept.
  void wait();
  /// Keeps the event until its command's success is known.
  void watch(const cl::Event& e, description what);
  /// Adds a failure to those that throw_asynchronous hands on.
  void report(std::exception_ptr failure) noexcept;
  /// Hands the failures of ended commands to the handler, or throws the first.
  void throw_asynchronous();

 private:
  struct watched {
    cl::Event event;
    description what;
  };
  void harvest();

  std::mutex mutex_;
  std::vector<watched> watched_;
  std::size_t watched_limit_ = 64;
  exception_list failures_;
};

}  // namespace facet::runtime::detail
