// A part of a picture.
#pragma once

#include <cstdint>
#include <utility>

namespace facet::tracer {

struct tile {
  std::uint32_t left, top, right, bottom;  ///< pixels; right and bottom are outside
  std::uint32_t width() const { return right - left; }
  std::uint32_t height() const { return bottom - top; }
  std::uint64_t pixels() const { return std::uint64_t(width()) * height(); }
};

/// Two parts of a tile of more than `width` x `height` pixels, cut at multiples of these from its
/// top left.
inline std::pair<tile, tile> halves(const tile& t, std::uint32_t width, std::uint32_t height) {
  tile first = t, second = t;
  const auto middle = [](std::uint32_t size, std::uint32_t step) {
    return (size / step + 1) / 2 * step;
  };
  if (t.height() > height)
    first.bottom = second.top = t.top + middle(t.height(), height);
  else
    first.right = second.left = t.left + middle(t.width(), width);
  return {first, second};
}

}  // namespace facet::tracer
