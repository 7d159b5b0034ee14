// Internal: a kernel's launch, checked against the kernel as compiled before the driver is asked.
#pragma once

#include <vector>

#include "runtime/command_group.hpp"
#include "runtime/program_state.hpp"

namespace facet::runtime::detail {

/// Throws errc::kernel_argument for arguments that do not match the kernel's, errc::nd_range for
/// sizes that it cannot have, errc::memory_allocation for too much local memory: with what was
/// found, what is allowed, and the kernel's name. A shape without a local size gets the one that
/// the kernel requires, if it does.
void check_launch(const kernel_state& k, launch_shape& shape,
                  const std::vector<argument>& arguments, const device& d);

/// Sets the arguments and enqueues.
void enqueue_launch(kernel_state& k, const launch_shape& shape,
                    const std::vector<argument>& arguments, const std::vector<std::byte>& values,
                    const cl::CommandQueue& queue, const std::vector<cl::Event>& waits,
                    cl::Event& done);

}  // namespace facet::runtime::detail
