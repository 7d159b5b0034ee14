// Pictures of several samples a pixel, by a work-item for each sample (cl/render_samples.cl). A
// pixel is their mean, added up in the same order as by one work-item.
#pragma once

#include "tracer/state.hpp"
#include "tracer/tile.hpp"

namespace facet::tracer {

class sample_renderer {
 public:
  /// Compiles, and makes room for the samples of `pixels` pixels, or of fewer if the device has not
  /// that much to spare.
  sample_renderer(device_scene::state& s, std::uint32_t max_depth, std::uint64_t pixels);

  /// Whether another would be no better for such a picture.
  bool suffices(std::uint32_t max_depth, std::uint64_t pixels) const {
    return max_depth == max_depth_ && pixels_for(pixels) <= most_pixels_;
  }

  /// The most pixels of a tile.
  std::uint64_t most_pixels() const { return most_pixels_; }

  kernel_description describe() const;

  /// Milliseconds on the device.
  double render(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& pixels);

 private:
  std::uint64_t pixels_for(std::uint64_t pixels) const;

  device_scene::state& state_;
  std::uint32_t max_depth_;
  std::uint64_t most_pixels_;
  runtime::program program_;
  runtime::kernel trace_, mean_;
  runtime::buffer<texel> samples_;
};

}  // namespace facet::tracer
