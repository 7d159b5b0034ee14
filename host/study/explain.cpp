#include "study/explain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace facet::study {
namespace {

constexpr double nearest_step = 0x1p-13, farthest_step = 0x1p-5;

float difference(const float* a, const float* b) {
  float worst = 0;
  for (int c = 0; c < 4; ++c) {
    if (std::isnan(a[c]) || std::isnan(b[c])) return std::numeric_limits<float>::quiet_NaN();
    worst = std::max(worst, std::abs(std::clamp(a[c], 0.0f, 1.0f) - std::clamp(b[c], 0.0f, 1.0f)));
  }
  return worst;
}

/// The smallest step in eight directions that changes what the sample at (x, y) meets; 0 if none.
template <class T>
double edge_near(const reference::tracer<T>& oracle, const reference::film<T>& film, T x, T y,
                 std::uint32_t max_depth) {
  const std::uint64_t here = oracle.signature(film, x, y, max_depth);
  for (double step = nearest_step; step <= farthest_step; step *= 2)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if ((dx != 0 || dy != 0) &&
            oracle.signature(film, x + T(dx * step), y + T(dy * step), max_depth) != here)
          return step;
  return 0;
}

template <class T>
double edge_in_pixel(const reference::tracer<T>& oracle, const reference::film<T>& film,
                     std::uint32_t px, std::uint32_t py, std::uint32_t samples,
                     std::uint32_t max_depth) {
  double best = 0;
  for (std::uint32_t j = 0; j < samples; ++j)
    for (std::uint32_t i = 0; i < samples; ++i) {
      const T x = T(px) + (T(i) + T(0.5)) / T(samples), y = T(py) + (T(j) + T(0.5)) / T(samples);
      const double edge = edge_near(oracle, film, x, y, max_depth);
      if (edge > 0 && (best == 0 || edge < best)) best = edge;
    }
  return best;
}

}  // namespace

std::uint64_t explanation::unexplained() const {
  return std::uint64_t(
      std::count_if(off.begin(), off.end(), [](const off_pixel& p) { return !p.is_explained(); }));
}

template <class T>
explanation explain(const scene& s, const reference::tracer<T>& oracle, const picture& expected,
                    const picture& found, std::uint32_t max_depth, float tolerance) {
  const reference::film<T> film(frame_of(s.view, expected.width, expected.height));
  explanation e;
  e.pixels = std::uint64_t(expected.width) * expected.height;
  e.tolerance = tolerance;
  for (std::uint32_t y = 0; y < expected.height; ++y)
    for (std::uint32_t x = 0; x < expected.width; ++x) {
      const float d = difference(expected.at(x, y), found.at(x, y));
      if (d <= tolerance) continue;
      const double edge =
          std::isnan(d) ? 0 : edge_in_pixel(oracle, film, x, y, s.samples, max_depth);
      e.off.push_back({x, y, d, edge});
    }
  return e;
}

template explanation explain(const scene&, const reference::tracer<float>&, const picture&,
                             const picture&, std::uint32_t, float);
template explanation explain(const scene&, const reference::tracer<double>&, const picture&,
                             const picture&, std::uint32_t, float);

}  // namespace facet::study
