// What the tests of the runtime share. FACET_TEST_DEVICE names another device than the first.
#pragma once

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "runtime/runtime.hpp"

namespace facet::test {

inline runtime::device device() {
  const char* name = std::getenv("FACET_TEST_DEVICE");
  return runtime::select_device(name ? name : "0");
}

inline runtime::queue& queue() {
  static runtime::queue q{device()};
  return q;
}

inline runtime::program program_of(const std::string& text, const std::string& options = "") {
  return {queue().get_context(), {{{"test.cl", text}}}, "test.cl", options};
}

/// The kernels that most tests need. Their work-items guard nothing: launch as many as elements.
inline runtime::kernel kernel(const std::string& name) {
  static const runtime::program p = program_of(R"(
__kernel void set(__global int* x, int value) { x[get_global_id(0)] = value; }
__kernel void add(__global int* x, int value) { x[get_global_id(0)] += value; }
__kernel void copy(__global const int* from, __global int* to) {
  to[get_global_id(0)] = from[get_global_id(0)];
}
)");
  return p.get_kernel(name);
}

inline runtime::event set(runtime::queue q, const runtime::buffer<int>& b, int value) {
  return q.submit([&](runtime::handler& h) {
    h.set_args(runtime::accessor{b, h, runtime::write_only}, value);
    h.parallel_for(runtime::range(b.size()), kernel("set"));
  });
}

inline runtime::event add(runtime::queue q, const runtime::buffer<int>& b, int value) {
  return q.submit([&](runtime::handler& h) {
    h.set_args(runtime::accessor{b, h, runtime::read_write}, value);
    h.parallel_for(runtime::range(b.size()), kernel("add"));
  });
}

inline runtime::event copy(runtime::queue q, const runtime::buffer<int>& from,
                           const runtime::buffer<int>& to) {
  return q.submit([&](runtime::handler& h) {
    h.set_args(runtime::accessor{from, h, runtime::read_only},
               runtime::accessor{to, h, runtime::write_only});
    h.parallel_for(runtime::range(from.size()), kernel("copy"));
  });
}

inline std::vector<int> contents(const runtime::buffer<int>& b) {
  const runtime::host_accessor read{b, runtime::read_only};
  return {read.begin(), read.end()};
}

/// An event that the test completes, or fails, when it likes: what waits for it cannot have run.
class gate {
 public:
  gate() : event_(clCreateUserEvent(queue().get_context().get(), nullptr)) {}
  ~gate() {
    open();
    clReleaseEvent(event_);
  }
  gate(const gate&) = delete;
  gate& operator=(const gate&) = delete;

  void open(cl_int status = CL_COMPLETE) {
    if (!opened_) clSetUserEventStatus(event_, status);
    opened_ = true;
  }
  runtime::event event() const { return runtime::event::from_native(event_); }

 private:
  cl_event event_;
  bool opened_ = false;
};

inline bool is_complete(const runtime::event& e) {
  return e.get_info<runtime::info::event::command_execution_status>() ==
         runtime::info::event_command_status::complete;
}

}  // namespace facet::test
