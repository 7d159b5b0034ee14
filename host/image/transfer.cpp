#include "image/transfer.hpp"

#include <cmath>

namespace facet::image {
namespace {

bool holds_nan(const float* rgba) {
  return std::isnan(rgba[0]) || std::isnan(rgba[1]) || std::isnan(rgba[2]) || std::isnan(rgba[3]);
}

}  // namespace

double srgb_from_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double value) {
  return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

std::uint8_t to_byte(float linear, transfer curve) {
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  const double shown = curve == transfer::srgb ? srgb_from_linear(linear) : double(linear);
  return std::uint8_t(shown * 255 + 0.5);
}

float from_byte(std::uint8_t level, transfer curve) {
  const double shown = level / 255.0;
  return float(curve == transfer::srgb ? linear_from_srgb(shown) : shown);
}

std::vector<std::uint8_t> to_bytes(const picture& p, transfer curve) {
  std::vector<std::uint8_t> bytes(p.rgba.size());
  for (std::size_t i = 0; i < bytes.size(); ++i)
    bytes[i] = to_byte(p.rgba[i], i % 4 == 3 ? transfer::linear : curve);
  return bytes;
}

std::size_t nan_count(const picture& p) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < p.rgba.size(); i += 4) count += holds_nan(&p.rgba[i]);
  return count;
}

nan_error::nan_error(std::size_t pixels, std::uint32_t x, std::uint32_t y)
    : std::runtime_error("the picture holds NaN in " + std::to_string(pixels) +
                         (pixels == 1 ? " pixel" : " pixels") + ", the first at (" +
                         std::to_string(x) + ", " + std::to_string(y) + ")"),
      pixels_(pixels) {}

void refuse_nan(const picture& p) {
  for (std::uint32_t y = 0; y < p.height; ++y)
    for (std::uint32_t x = 0; x < p.width; ++x)
      if (holds_nan(p.at(x, y))) throw nan_error(nan_count(p), x, y);
}

}  // namespace facet::image
