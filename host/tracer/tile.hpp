// A part of a picture.
#pragma once

#include <cstdint>

namespace facet::tracer {

struct tile {
  std::uint32_t left, top, right, bottom;  ///< pixels; right and bottom are outside
  std::uint32_t width() const { return right - left; }
  std::uint32_t height() const { return bottom - top; }
  std::uint64_t pixels() const { return std::uint64_t(width()) * height(); }
};

}  // namespace facet::tracer
