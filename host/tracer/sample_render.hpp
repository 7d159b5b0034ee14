// Pictures by a work-item for each sample (cl/render_samples.cl), those that are likely to take
// longest first. A pixel is its samples' mean, added up in the same order as by one work-item.
#pragma once

#include <functional>
#include <vector>

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
  void add_programs(program_set& to) const { to.add(program_); }

  /// Milliseconds on the device.
  double render(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& pixels);

 private:
  /// Of several samples; else a sample is a pixel.
  bool has_means() const;
  std::uint64_t pixels_for(std::uint64_t pixels) const;
  runtime::range<2> group() const;
  runtime::nd_range<2> all_samples(const tile& t) const;

  void run(const std::function<void(runtime::handler&)>& group);
  /// Which work-groups are likely to take long, and all with them first.
  void mark(const tile& t, runtime::buffer<View>& view);
  void list(const tile& t);
  bool pays_to_list(const tile& t) const;
  void trace(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& to,
             bool is_listed);
  void mean(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& pixels);

  device_scene::state& state_;
  std::uint32_t max_depth_;
  std::uint64_t most_pixels_;
  runtime::program program_;
  runtime::kernel mark_, list_, trace_, mean_;
  runtime::buffer<texel> samples_;  ///< none where a pixel has one
  runtime::buffer<std::uint32_t> marks_, groups_;
  runtime::buffer<Faults> untold_;    ///< of the rays that tell what takes long
  std::vector<runtime::event> done_;  ///< of the last tile
};

}  // namespace facet::tracer
