// Errors: SYCL 2020's exception and codes (section 4.13), with OpenCL's own code kept.
#pragma once

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace facet::runtime {

/// SYCL 2020's error codes.
enum class errc {
  success,
  runtime,
  kernel,
  accessor,
  nd_range,
  event,
  kernel_argument,
  build,
  invalid,
  memory_allocation,
  platform,
  profiling,
  feature_not_supported,
  kernel_not_supported,
  backend_mismatch,
};

/// Anything that went wrong. The message holds what was found, what is allowed, and, where they
/// apply, the OpenCL call, its code's name, the kernel, its options and the build log.
class exception : public std::runtime_error {
 public:
  exception(errc code, const std::string& message, int cl_code = 0)
      : std::runtime_error(message), code_(code), cl_code_(cl_code) {}

  errc code() const noexcept { return code_; }
  /// OpenCL's code (CL_OUT_OF_RESOURCES is -5), or 0 if no call failed.
  int cl_code() const noexcept { return cl_code_; }

 private:
  errc code_;
  int cl_code_;
};

/// Errors of commands that failed after they were submitted, oldest first.
using exception_list = std::vector<std::exception_ptr>;
/// Receives them, on the thread that calls wait_and_throw() or throw_asynchronous().
using async_handler = std::function<void(exception_list)>;

/// "CL_OUT_OF_RESOURCES" for -5; "unknown OpenCL code" for a code that no header names.
const char* code_name(int cl) noexcept;

/// The error code that stands for one of OpenCL's.
errc errc_of(int cl) noexcept;

/// The exception for an OpenCL call that failed: "clCreateBuffer: CL_INVALID_VALUE (-30)", then
/// `where` in the same line if it is not empty.
exception failed_call(const char* call, int cl, std::string_view where = {});

}  // namespace facet::runtime
