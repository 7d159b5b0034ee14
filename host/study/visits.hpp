// What a ray visits on its way through a tree, counted by the kernels themselves.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tracer/tracer.hpp"

namespace facet::study {

/// Of one ray.
struct visits {
  std::uint32_t nodes;      ///< whose children's boxes it was tested against
  std::uint32_t triangles;  ///< that it was tested against; in the wide layout, blocks of them
  std::uint32_t total() const { return nodes + triangles; }
};

/// The tracer whose hits hold counts, ray by ray, and are for count_visits alone.
tracer::options counting_visits(tracer::options o);

/// `counting` is made with counting_visits; `any` as in device_scene::trace.
std::vector<visits> count_visits(tracer::device_scene& counting, std::span<const tracer::ray> rays,
                                 bool any);

/// Bytes that a visit reads.
struct visit_bytes {
  std::uint32_t node, triangle;
};
/// layout: as statistics have it.
visit_bytes visit_bytes_of(const std::string& layout);

}  // namespace facet::study
