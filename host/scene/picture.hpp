// A picture in memory: linear RGBA, before any clamp or transfer curve.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facet {

struct picture {
  std::uint32_t width = 0, height = 0;
  /// height * width * 4 floats, row by row from the top, RGBA; colour linear, alpha 0 to 1.
  std::vector<float> rgba;

  picture() = default;
  picture(std::uint32_t columns, std::uint32_t rows)
      : width(columns), height(rows), rgba(std::size_t(columns) * rows * 4) {}

  float* at(std::uint32_t x, std::uint32_t y) { return &rgba[(std::size_t(y) * width + x) * 4]; }
  const float* at(std::uint32_t x, std::uint32_t y) const {
    return &rgba[(std::size_t(y) * width + x) * 4];
  }
};

}  // namespace facet
