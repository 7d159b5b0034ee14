// Why two pictures differ: each pixel that is off is either at an edge, or wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/tracer.hpp"
#include "scene/picture.hpp"
#include "scene/scene.hpp"

namespace facet::study {

struct off_pixel {
  std::uint32_t x = 0, y = 0;
  float difference =
      0;  ///< largest of the channels, both clamped to [0, 1]; NaN if either holds one
  /// How far, in pixels, a sample must move until its rays meet other surfaces: 2^-13 to 2^-5.
  /// 0 if they never do: the difference is then not explained.
  double edge_within = 0;
  bool is_explained() const { return edge_within > 0; }
};

struct explanation {
  std::uint64_t pixels = 0;
  float tolerance = 0;
  std::vector<off_pixel> off;  ///< those that differ by more than the tolerance
  std::uint64_t unexplained() const;
};

/// Compares a picture with the reference's of the same size, over linear channels clamped to
/// [0, 1]. A pixel that is off is explained if one of its samples, moved by at most 2^-5 pixels,
/// meets other surfaces on its way, shadows included (reference::tracer::signature): it lies at a
/// silhouette, an edge or a shadow's border, where rounding alone may decide. Rounding moves an eye
/// ray by about 2^-24 of the picture's width; curved mirrors and glass magnify that, hence the
/// range.
template <class T>
explanation explain(const scene& s, const reference::tracer<T>& oracle, const picture& expected,
                    const picture& found, std::uint32_t max_depth, float tolerance = 1.0f / 255);

}  // namespace facet::study
