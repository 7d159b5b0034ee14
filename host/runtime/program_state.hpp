// Internal: what programs and kernels hold, asked of the driver once.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "runtime/context_state.hpp"
#include "runtime/queue_state.hpp"

namespace facet::runtime::detail {

struct program_state {
  std::shared_ptr<context_state> context;
  cl::Program program;
  std::string options, log;
  double build_ms = 0;
};

/// What CL_KERNEL_ARG_INFO tells of one argument.
struct parameter {
  enum class space { unknown, global, constant, local, value };
  space where = space::unknown;
  bool is_image = false;
  bool read_by_kernel = true, written_by_kernel = true;  ///< as its qualifiers allow
  std::string text;                                      ///< as declared: "__global float* out"
};

/// A kernel's limits on one device, as compiled.
struct kernel_limits {
  std::size_t work_group_size = 0, preferred_multiple = 1;
  std::array<std::size_t, 3> required{};    ///< reqd_work_group_size, or zeros
  std::array<std::size_t, 3> most_items{};  ///< of a group along each dimension: the device's
  std::uint64_t private_bytes = 0, local_bytes = 0;
};

struct kernel_state {
  std::shared_ptr<const program_state> program;
  cl::Kernel kernel;
  std::string name;
  description what;  ///< with the program's options
  std::vector<parameter> parameters;
  std::map<native::device, kernel_limits> limits;
  std::mutex mutex;  ///< from the first argument set to the launch

  /// Throws errc::invalid for a device outside the program's context.
  const kernel_limits& limits_on(const device& d) const;
};

std::shared_ptr<kernel_state> make_kernel(std::shared_ptr<const program_state> program,
                                          const std::string& name);

}  // namespace facet::runtime::detail
