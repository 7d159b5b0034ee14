#include "study/picture_errors.hpp"

#include <algorithm>
#include <array>
#include <bit>

#include "image/flip.hpp"
#include "study/cases/lab.hpp"
#include "study/parallel.hpp"

namespace facet::study {
namespace {

constexpr double steps[] = {0x1p-13, 0x1p-10, 0x1p-7, 0x1p-5};  // pixels

picture pixel_of(const picture& p, std::size_t pixel) {
  picture one(1, 1);
  std::copy_n(p.rgba.begin() + std::ptrdiff_t(4 * pixel), 4, one.rgba.begin());
  return one;
}

bool is_off(const picture& one, const picture& other) {
  const image::difference d = image::compare(one, other);
  return d.pixels_off > 0 || d.pixels_off_displayed > 0;
}

bool is_same(const picture& a, const picture& b, std::size_t pixel) {
  const auto at = std::ptrdiff_t(4 * pixel);
  return std::equal(a.rgba.begin() + at, a.rgba.begin() + at + 4, b.rgba.begin() + at,
                    [](float x, float y) {
                      return std::bit_cast<std::uint32_t>(x) == std::bit_cast<std::uint32_t>(y);
                    });
}

}  // namespace

std::uint64_t differing_pixels(const picture& a, const picture& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.rgba.size() / 4; ++i) count += !is_same(a, b, i);
  return count;
}

picture_oracle::picture_oracle(const scene& s, const reference::tracer<double>& exact,
                               std::uint32_t width, std::uint32_t height, std::uint32_t max_depth,
                               unsigned threads, std::function<void()> check)
    : scene_(s),
      exact_(exact),
      max_depth_(max_depth),
      threads_(threads),
      check_(std::move(check)),
      expected_(width, height) {
  const reference::film<double> film(frame_of(s.view, width, height));
  const std::uint32_t n = s.samples;
  // Column by column: the parts of a picture from left to right cost alike, sky and ground do not.
  in_parallel(threads, std::uint64_t(width) * height, [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t k = first; k < last; ++k) {
      if (check_ && k % 64 == 0) check_();
      const auto x = std::uint32_t(k / height), y = std::uint32_t(k % height);
      std::array<double, 4> sum{};
      for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
          const auto sample = exact.pixel(film, x + (i + 0.5) / n, y + (j + 0.5) / n, max_depth);
          for (std::size_t c = 0; c < 4; ++c) sum[c] += sample[c];
        }
      for (std::size_t c = 0; c < 4; ++c) expected_.at(x, y)[c] = float(sum[c] / double(n * n));
    }
  });
}

picture_oracle::nearby picture_oracle::look_around(std::size_t pixel) const {
  const std::uint32_t width = expected_.width, n = scene_.samples;
  const reference::film<double> film(frame_of(scene_.view, width, expected_.height));
  const auto px = double(pixel % width), py = double(pixel / width);
  std::array<double, 4> least{}, most{};
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const double x = px + (i + 0.5) / n, y = py + (j + 0.5) / n;
      std::array<double, 4> low = exact_.pixel(film, x, y, max_depth_), high = low;
      for (const double step : steps)
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const auto v = exact_.pixel(film, x + dx * step, y + dy * step, max_depth_);
            for (std::size_t c = 0; c < 4; ++c)
              low[c] = std::min(low[c], v[c]), high[c] = std::max(high[c], v[c]);
          }
      for (std::size_t c = 0; c < 4; ++c) least[c] += low[c], most[c] += high[c];
    }
  nearby r;
  for (std::size_t c = 0; c < 4; ++c) {
    r.least.rgba[c] = float(least[c] / double(n * n));
    r.most.rgba[c] = float(most[c] / double(n * n));
  }
  return r;
}

bool picture_oracle::is_silhouette(const picture& found, std::size_t pixel) const {
  const nearby& r = around_.at(pixel);
  const picture is = pixel_of(found, pixel);
  picture nearest = is;  // NaN stays what it is, and off
  for (std::size_t c = 0; c < 4; ++c) {
    if (is.rgba[c] < r.least.rgba[c]) nearest.rgba[c] = r.least.rgba[c];
    if (is.rgba[c] > r.most.rgba[c]) nearest.rgba[c] = r.most.rgba[c];
  }
  const image::difference d = image::compare(nearest, is);
  return d.pixels_off == 0 && d.pixels_off_displayed == 0;
}

picture_errors picture_oracle::judge(const picture& found, const picture& strict) {
  picture_errors e;
  e.all = image::compare(expected_, found);
  std::vector<std::size_t> off;
  for (std::size_t i = 0; i < found.rgba.size() / 4; ++i)
    if (is_off(pixel_of(expected_, i), pixel_of(found, i))) off.push_back(i);
  if (off.size() > most_asked) {
    std::sort(off.begin(), off.end(),
              [](std::size_t a, std::size_t b) { return draw(0, a).bits() < draw(0, b).bits(); });
    off.resize(most_asked);
  }
  e.asked = off.size();

  std::vector<std::size_t> unknown;
  for (const std::size_t i : off)
    if (!around_.contains(i)) unknown.push_back(i);
  std::vector<nearby> looked(unknown.size());
  in_parallel(threads_, unknown.size(), [&](std::uint64_t first, std::uint64_t last) {
    for (std::uint64_t k = first; k < last; ++k) {
      if (check_) check_();
      looked[k] = look_around(unknown[k]);
    }
  });
  for (std::size_t k = 0; k < unknown.size(); ++k) around_.emplace(unknown[k], looked[k]);

  std::vector<bool> silhouettes(found.rgba.size() / 4);
  for (const std::size_t i : off) silhouettes[i] = is_silhouette(found, i);
  e.rest = image::compare(expected_, found, silhouettes);
  e.silhouettes = e.rest.left_out;
  e.off_displayed_explained = e.all.pixels_off_displayed - e.rest.pixels_off_displayed;
  const image::flip_map seen = image::flip(expected_, found);
  e.flip_mean = seen.mean, e.flip_max = seen.max;
  e.other_bits = differing_pixels(found, strict);
  return e;
}

}  // namespace facet::study
