// Commands of the builders, and memory that they keep from one run to the next.
#pragma once

#include <cstddef>

#include "runtime/runtime.hpp"

namespace facet::tracer {

/// A command, for who wants to know its time.
struct step {
  const char* kernel;
  runtime::event done;
};

/// Room for `count` elements: what there is, or new.
template <class T>
void hold(runtime::buffer<T>& b, std::size_t count) {
  if (b.size() < count) b = runtime::buffer<T>(count);
}

}  // namespace facet::tracer
