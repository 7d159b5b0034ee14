// Internal: OpenCL's C++ bindings as this folder uses them, nothing above OpenCL 1.2. No public
// header includes this one.
#pragma once

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#include <CL/opencl.hpp>

#include <string_view>
#include <utility>

#include "runtime/error.hpp"

namespace facet::runtime::detail {

/// Runs f; a failed OpenCL call in it becomes an exception with the call's name and `where`.
template <class F>
decltype(auto) call(F&& f, std::string_view where = {}) {
  try {
    return std::forward<F>(f)();
  } catch (const cl::Error& e) {
    throw failed_call(e.what(), e.err(), where);
  }
}

}  // namespace facet::runtime::detail
