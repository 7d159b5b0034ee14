#include "image/compare.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "image/transfer.hpp"

namespace facet::image {
namespace {

// Two neighbouring levels k/255 are "1/255 apart" however their floats were rounded: each value
// is off by at most 2^-25.
constexpr double one_level = 1.0 / 255 + 0x1p-24;

double shown(float value) { return std::clamp(double(value), 0.0, 1.0); }

double distance(float a, float b) {
  if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b) ? 0 : 1;
  return std::abs(shown(a) - shown(b));
}

bool displayed_apart(float a, float b, transfer curve) {
  return std::abs(int(to_byte(a, curve)) - int(to_byte(b, curve))) > 1;
}

std::string size_of(const picture& p) {
  return std::to_string(p.width) + "x" + std::to_string(p.height);
}

}  // namespace

difference compare(const picture& a, const picture& b) {
  return compare(a, b, std::vector<bool>(std::size_t(a.width) * a.height));
}

difference compare(const picture& a, const picture& b, const std::vector<bool>& left_out) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument("the pictures differ in size: " + size_of(a) + " and " +
                                size_of(b));
  difference d;
  d.width = a.width, d.height = a.height;
  double sum = 0, sum_of_squares = 0;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    // Summed by row, so that a large picture's small errors are not lost in a large sum.
    double row_sum = 0, row_squares = 0;
    for (std::uint32_t x = 0; x < a.width; ++x) {
      if (left_out[std::size_t(y) * a.width + x]) {
        ++d.left_out;
        continue;
      }
      const float *p = a.at(x, y), *q = b.at(x, y);
      bool nan = false, off = false, off_displayed = false;
      for (int channel = 0; channel < 4; ++channel) {
        const bool alpha = channel == 3;
        const double e = distance(p[channel], q[channel]);
        nan |= std::isnan(p[channel]) || std::isnan(q[channel]);
        off |= e > one_level;
        off_displayed |=
            displayed_apart(p[channel], q[channel], alpha ? transfer::linear : transfer::srgb);
        if (alpha) {
          d.alpha_max = std::max(d.alpha_max, e);
          continue;
        }
        row_sum += e, row_squares += e * e;
        if (e > d.max) d.max = e, d.worst_x = x, d.worst_y = y;
      }
      d.nan_pixels += nan;
      d.pixels_off += off || nan;
      d.pixels_off_displayed += off_displayed || nan;
    }
    sum += row_sum, sum_of_squares += row_squares;
  }
  const double values = 3 * double(d.pixels());
  if (values > 0) d.mean = sum / values, d.rmse = std::sqrt(sum_of_squares / values);
  d.psnr = d.rmse > 0 ? -20 * std::log10(d.rmse) : std::numeric_limits<double>::infinity();
  return d;
}

}  // namespace facet::image
