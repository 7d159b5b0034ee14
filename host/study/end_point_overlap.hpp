// The end-point overlap of a tree: how much work a ray's end costs beyond that of finding what it
// ends on (T. Aila, T. Karras, S. Laine, "On quality metrics of bounding volume hierarchies",
// High-Performance Graphics 2013).
#pragma once

#include <cstdint>
#include <span>

#include "tracer/plain_tree.hpp"

namespace facet::study {

struct end_point_overlap {
  /// Sum over nodes n of C(n) * (area of the surface that lies in n's box and is not of n's
  /// subtree), by the area of the whole surface. C is 1 for an inner node and its triangles for a
  /// leaf. 0 if the surface has no area.
  double value = 0;
  double standard_error = 0;    ///< 0 where all triangles were looked at
  std::uint64_t triangles = 0;  ///< looked at
  bool is_sampled = false;
};

/// Of a mesh's tree; triangle i has corners[3 * i ..]. Each triangle is clipped to each box that
/// it meets outside its own way down; boxes are closed, so that a triangle in a box's side lies in
/// it. With more than `samples` > 1 triangles as many are drawn instead, each as often as its area
/// says, with replacement: the mean of what they find is unbiased. The same seed draws the same
/// triangles everywhere.
end_point_overlap overlap_of(const tracer::plain_tree& t, std::span<const tracer::texel> corners,
                             std::uint64_t samples, std::uint64_t seed);

}  // namespace facet::study
