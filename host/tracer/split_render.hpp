// Pictures by several kernels (cl/render_split.cl): the rays of one depth are traced by one launch
// and shaded by another. A sample's light is added up in the same order as by one kernel.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tracer/state.hpp"
#include "tracer/tile.hpp"

namespace facet::tracer {

class split_renderer {
 public:
  /// Compiles, and makes room for trees of rays over `pixels` pixels, or fewer if the device has
  /// not that much to spare.
  split_renderer(device_scene::state& s, std::uint32_t max_depth, std::uint64_t pixels);

  /// Whether another would be no better for such a picture.
  bool suffices(std::uint32_t max_depth, std::uint64_t pixels) const {
    return max_depth == max_depth_ && capacity_for(pixels) <= capacity_;
  }

  /// The most pixels of a tile.
  std::uint64_t most_pixels() const { return capacity_ / rays_a_pixel; }

  kernel_description describe() const;

  /// False if the tile's rays had no room: ask for a smaller one. Adds milliseconds on the device
  /// to `ms`, by kernel and depth.
  bool render(const tile& t, runtime::buffer<View>& view, runtime::buffer<texel>& pixels,
              std::map<std::string, double>& ms);

 private:
  /// What there is room for on average. Where a tile has more, it is made again in parts.
  static constexpr std::uint32_t rays_a_pixel = 4;

  std::uint64_t capacity_for(std::uint64_t pixels) const;
  bool sample(const tile& t, std::uint32_t index, runtime::buffer<View>& view,
              runtime::buffer<texel>& pixels);
  void eye_rays(const tile& t, std::uint32_t index, std::uint32_t count,
                runtime::buffer<View>& view);
  void trace_rays(std::uint32_t depth, std::uint32_t first, std::uint32_t count,
                  runtime::buffer<View>& view);
  void shade_rays(std::uint32_t depth, std::uint32_t first_hit, std::uint32_t hits,
                  std::uint32_t eyes, runtime::buffer<View>& view);
  void light_rays(std::uint32_t hits, std::uint32_t light);
  void sum_samples(const tile& t, std::uint32_t index, std::uint32_t count,
                   runtime::buffer<View>& view, runtime::buffer<texel>& pixels);
  std::uint32_t set_rays(runtime::handler& h, std::uint32_t k);
  std::uint32_t set_surfaces(runtime::handler& h, std::uint32_t k);
  void run(std::string name, const std::function<void(runtime::handler&)>& group);

  device_scene::state& state_;
  std::uint32_t max_depth_, group_;
  std::uint64_t capacity_;  ///< rays
  runtime::program program_;
  runtime::kernel eye_, trace_, shade_, light_, sum_;
  runtime::buffer<texel> origins_, directions_, throughputs_, hits_, surfaces_;
  runtime::buffer<std::uint32_t> media_;
  runtime::buffer<std::array<std::uint32_t, 2>> hit_rays_;
  runtime::buffer<RayNode> tree_;
  runtime::buffer<std::uint32_t> lit_hits_;
  runtime::buffer<std::uint32_t> counts_;                     ///< of a sample (cl/render_split.cl)
  std::vector<std::pair<std::string, runtime::event>> done_;  ///< of the tile under way
};

}  // namespace facet::tracer
