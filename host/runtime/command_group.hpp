// Internal: a command group from its first accessor to its place in the queue.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "runtime/access.hpp"
#include "runtime/event.hpp"
#include "runtime/handler.hpp"
#include "runtime/memory_state.hpp"
#include "runtime/queue_state.hpp"

namespace facet::runtime::detail {

/// A kernel's argument as it was set; `bytes` are in the group's values from `offset` on.
struct argument {
  enum class kind { unset, value, memory, local };
  kind what = kind::unset;
  std::size_t offset = 0, bytes = 0;
  const memory* object = nullptr;
  access_mode mode = access_mode::read;
};

struct requirement {
  std::shared_ptr<memory> object;
  access_mode mode;
  bool discard;
};

struct command_group {
  /// Enqueues on the queue, behind these events, and gives the command's own.
  using action =
      std::function<void(const cl::CommandQueue&, const std::vector<cl::Event>&, cl::Event&)>;

  explicit command_group(std::shared_ptr<queue_state> q) : queue(std::move(q)) {}

  void require(const std::shared_ptr<memory>& m, access_mode mode, bool discard);
  bool requires_memory(const memory& m) const;
  /// Throws errc::invalid for a second action.
  void act(description called, action a);
  /// Enqueues the action behind all that it depends on.
  event finish();

  std::shared_ptr<queue_state> queue;
  std::vector<requirement> requirements;
  std::vector<argument> arguments;
  std::vector<std::byte> values;
  std::vector<command> after;  ///< depends_on
  std::shared_ptr<kernel_state> launched;
  launch_shape shape;

 private:
  std::vector<cl::Event> wait_list(const std::vector<command>& behind) const;

  description what_;
  action action_;
};

}  // namespace facet::runtime::detail
