// The device's rays and hits beside those of the reference.
#pragma once

#include <cstring>

#include "reference/tracer.hpp"
#include "tracer/tracer.hpp"

namespace facet::test {

inline reference::ray<float> to_reference(const tracer::ray& r) {
  return {{r.origin[0], r.origin[1], r.origin[2]},
          r.tmin,
          {r.direction[0], r.direction[1], r.direction[2]},
          r.tmax};
}

inline bool same_bits(const tracer::hit& a, const reference::hit<float>& b) {
  return std::memcmp(&a.t, &b.t, 4) == 0 && std::memcmp(&a.u, &b.u, 4) == 0 &&
         std::memcmp(&a.v, &b.v, 4) == 0 && a.instance == b.instance && a.triangle == b.triangle;
}

}  // namespace facet::test
