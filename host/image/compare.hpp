// How far two pictures lie apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/picture.hpp"

namespace facet::image {

/// Every value is first clamped to [0, 1], so that brightness which no screen shows counts
/// nothing. Errors are over the linear colour channels (RGB, all pixels); "off" counts look at
/// all four channels.
struct difference {
  std::uint32_t width = 0, height = 0;
  double max = 0;        ///< largest |a - b| of a colour channel, 0 to 1
  double mean = 0;       ///< mean |a - b|
  double rmse = 0;       ///< root of the mean (a - b)^2
  double psnr = 0;       ///< 20 log10(1 / rmse) in dB; infinite for equal pictures
  double alpha_max = 0;  ///< largest |a - b| of alpha

  /// Pixels with a channel whose linear values lie more than 1/255 apart.
  std::uint64_t pixels_off = 0;
  /// Pixels with a channel whose displayed levels (sRGB, 8 bits; alpha linear) are two or more
  /// apart.
  std::uint64_t pixels_off_displayed = 0;
  /// Pixels with NaN in either picture. Each counts as off, and with an error of 1 in the channels
  /// where not both are NaN.
  std::uint64_t nan_pixels = 0;

  /// The pixel of `max`, the first in reading order (0, 0 for equal pictures).
  std::uint32_t worst_x = 0, worst_y = 0;

  std::uint64_t left_out = 0;  ///< pixels that nothing above looks at
  std::uint64_t pixels() const { return std::uint64_t(width) * height - left_out; }
  double share_off() const { return pixels() ? double(pixels_off) / double(pixels()) : 0; }
  double share_off_displayed() const {
    return pixels() ? double(pixels_off_displayed) / double(pixels()) : 0;
  }
};

/// Throws std::invalid_argument, naming both sizes, if they differ.
difference compare(const picture& a, const picture& b);
/// Without the pixels whose place in `left_out` (row by row from the top) is true.
difference compare(const picture& a, const picture& b, const std::vector<bool>& left_out);

}  // namespace facet::image
