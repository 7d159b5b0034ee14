// From linear floats to the eight bits that a screen shows, and back.
#pragma once

#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "scene/picture.hpp"

namespace facet::image {

/// How a colour channel in [0, 1] becomes 0 to 255. Alpha is linear under either.
enum class transfer {
  srgb,    ///< IEC 61966-2-1: what a screen expects
  linear,  ///< x255 and nothing else
};

/// The curve of IEC 61966-2-1 over [0, 1], and its inverse.
double srgb_from_linear(double value);
double linear_from_srgb(double value);

/// Clamped to [0, 1], curved, scaled to 255 and rounded to the nearest (halves up). NaN has no
/// colour: ask `nan_count` first; here it becomes 0.
std::uint8_t to_byte(float linear, transfer curve);
/// The linear value that the middle of a level stands for: level / 255 through the inverse curve.
float from_byte(std::uint8_t level, transfer curve);

/// height * width * 4 bytes, RGBA, row by row from the top.
std::vector<std::uint8_t> to_bytes(const picture& p, transfer curve);

/// Pixels with a NaN in any channel.
std::size_t nan_count(const picture& p);

/// Thrown for a picture that cannot be shown; nothing was written.
class nan_error : public std::runtime_error {
 public:
  nan_error(std::size_t pixels, std::uint32_t x, std::uint32_t y);
  std::size_t pixels() const noexcept { return pixels_; }

 private:
  std::size_t pixels_;
};

/// Throws nan_error, naming how many pixels hold NaN and the first of them.
void refuse_nan(const picture& p);

}  // namespace facet::image
