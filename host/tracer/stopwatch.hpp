// The host's clock, in milliseconds.
#pragma once

#include <chrono>

namespace facet::tracer {

using clock = std::chrono::steady_clock;

inline double milliseconds_since(clock::time_point start) {
  return std::chrono::duration<double, std::milli>(clock::now() - start).count();
}

}  // namespace facet::tracer
