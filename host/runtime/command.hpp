// Internal: commands that were enqueued, and which of them a use of memory must wait for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/access.hpp"
#include "runtime/opencl.hpp"

namespace facet::runtime::detail {

struct command {
  cl::Event event;
  cl::CommandQueue queue;  ///< null for an event that the caller made
  bool in_order = false;   ///< the queue's order
};

/// Adds `c` unless its event is there.
void add_once(std::vector<command>& to, const command& c);

/// What was done to one piece of memory that later commands may conflict with: the last write and
/// the reads since. Reads wait for the write, so a write need wait only for the reads, if any.
class hazards {
 public:
  /// Adds the commands that a use of this mode must wait for.
  void collect(access_mode mode, std::vector<command>& to) const;
  /// Enters a command that was enqueued behind those.
  void record(access_mode mode, const command& c);

 private:
  void forget_ended_reads();

  std::optional<command> last_write_;
  std::vector<command> reads_;
  std::size_t reads_limit_ = 16;  ///< of the reads kept before those that ended are dropped
};

/// The execution status: negative if the command failed.
cl_int status_of(const cl::Event& e);
/// A failed command's status in words. Drivers that know no reason give -1.
std::string failure_text(cl_int status);
/// Flushes the command's queue and waits for its end, failed or not.
void wait_for(const command& c);
/// errc::event: a command that this one depends on failed, and what it wrote is not there.
exception failed_dependency(cl_int status);
/// Waits for several; throws failed_dependency if one of them failed.
void wait_for_success(const std::vector<command>& commands);

}  // namespace facet::runtime::detail
