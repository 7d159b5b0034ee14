// The device that the tests of kernels run on: FACET_TEST_DEVICE names another than the first.
#pragma once

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

template <class T>
std::vector<T> content(const runtime::buffer<T>& b) {
  const runtime::host_accessor read{b, runtime::read_only};
  return {read.begin(), read.end()};
}

}  // namespace facet::test
