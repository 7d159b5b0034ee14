// The serial reference beside the device: the same ray, the same bits.
#pragma once

#include <bit>

#include "reference/ray.hpp"
#include "study/cases/lab.hpp"

namespace facet::study {

inline reference::ray<float> serial_ray(const tracer::ray& r) {
  return {origin_of(r), r.tmin, direction_of(r), r.tmax};
}
inline reference::ray<double> double_ray(const tracer::ray& r) {
  return {vec3d(origin_of(r)), r.tmin, vec3d(direction_of(r)), r.tmax};
}

/// All bits of (t, u, v, instance, triangle).
inline bool same_hit(const tracer::hit& h, const reference::hit<float>& expected) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  return bits(h.t) == bits(expected.t) && bits(h.u) == bits(expected.u) &&
         bits(h.v) == bits(expected.v) && h.instance == expected.instance &&
         h.triangle == expected.triangle;
}

}  // namespace facet::study
