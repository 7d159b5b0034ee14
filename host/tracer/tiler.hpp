// A picture in parts: each is one launch, or two.
#pragma once

#include <algorithm>

#include "tracer/tile.hpp"
#include "tracer/tracer.hpp"

namespace facet::tracer {

/// What a launch should take: no watchdog fires, progress moves, Ctrl-C is answered.
constexpr double launch_ms = 50;

/// Hands out the picture's tiles from the top left, row by row. With no size given a tile is as
/// many whole rows as the last one's speed says fit into launch_ms, and at most 4 times more than
/// before; the first is a 32nd of the picture. No tile has more than `most_pixels`, but for those
/// of one row of work-groups.
class tiler {
 public:
  tiler(std::uint32_t width, std::uint32_t height, const options& o, std::uint32_t group_height,
        std::uint64_t most_pixels)
      : width_(width),
        height_(height),
        fixed_width_(o.tile_width),
        fixed_height_(o.tile_height),
        step_(group_height),
        most_rows_(std::uint32_t(std::clamp<std::uint64_t>(most_pixels / width, 1, height))),
        rows_(round_up(std::max(1u, height / 32))) {}

  bool next(tile& t) {
    if (top_ >= height_) return false;
    const std::uint32_t w = fixed_width_ ? fixed_width_ : width_;
    const std::uint32_t h = std::min(fixed_height_ ? fixed_height_ : rows_, most_rows_);
    t = {left_, top_, std::min(width_, left_ + std::min(w, width_)),
         std::min(height_, top_ + std::min(h, height_))};
    if (t.right == width_)
      left_ = 0, top_ = t.bottom;
    else
      left_ = t.right;
    return true;
  }

  void took(const tile& t, double ms) {
    const double fits = (t.bottom - t.top) * launch_ms / std::max(ms, 1e-3);
    rows_ = round_up(std::uint32_t(std::clamp(fits, 1.0, 4.0 * rows_)));
  }

 private:
  std::uint32_t round_up(std::uint32_t rows) const {
    return std::min(height_ + step_, (rows + step_ - 1) / step_ * step_);
  }

  std::uint32_t width_, height_, fixed_width_, fixed_height_, step_, most_rows_, rows_;
  std::uint32_t left_ = 0, top_ = 0;
};

}  // namespace facet::tracer
