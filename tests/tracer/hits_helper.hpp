// What a way to trace finds, beside the reference.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/reference_helper.hpp"
#include "tracer/tracer.hpp"

namespace facet::test {

/// Rays traced together where they can be.
inline tracer::options in_packets() {
  tracer::options o;
  o.layout = tracer::layout_kind::wide;
  o.packets = tracer::packet_kind::on;
  return o;
}

/// Rays whose closest hit has other bits than the reference's, or of which any hit says otherwise
/// whether there is one.
inline std::size_t differing_from_reference(const scene& s, const std::vector<tracer::ray>& rays,
                                            tracer::options o) {
  const reference::tracer<float> serial(s);
  tracer::device_scene on(queue(), s, std::move(o));
  const auto hits = on.trace(rays), any = on.trace(rays, true);
  std::size_t differing = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto e = serial.closest(to_reference(rays[i]));
    differing += !same_bits(hits[i], e) ||
                 (any[i].triangle != tracer::miss) != (e.instance != reference::miss);
  }
  return differing;
}

inline std::size_t hits_of(const scene& s, const std::vector<tracer::ray>& rays,
                           tracer::options o) {
  const auto hits = tracer::device_scene(queue(), s, std::move(o)).trace(rays);
  return std::size_t(std::count_if(
      hits.begin(), hits.end(), [](const tracer::hit& h) { return h.triangle != tracer::miss; }));
}

}  // namespace facet::test
