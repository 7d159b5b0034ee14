// Internal: what an event holds.
#pragma once

#include <memory>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/queue_state.hpp"

namespace facet::runtime::detail {

struct event_state {
  command of;
  std::shared_ptr<queue_state> owner;  ///< null for an event that the caller made
  std::vector<command> behind;         ///< commands that it depends on
};

}  // namespace facet::runtime::detail
