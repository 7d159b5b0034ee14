// How wrong a picture is against the double reference's: its linear values, what a screen shows of
// them, and which of its pixels are wrong at silhouettes alone.
//
// explain.hpp asks whether any surface changes near a pixel; seen through glass of many triangles
// one nearly always does. Here a pixel must have a value that the double reference itself has
// nearby: what a variant leaves out at a silhouette, or a hole in a wall, is not explained by one.
#pragma once

#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

#include "image/compare.hpp"
#include "reference/tracer.hpp"
#include "scene/picture.hpp"
#include "scene/scene.hpp"

namespace facet::study {

/// Pixels that are off in the sense of image::compare, in linear or in displayed values, of which
/// this many are asked whether they are silhouettes, at most; of more, ones drawn by a hash.
inline constexpr std::size_t most_asked = 2000;

struct picture_errors {
  image::difference all;    ///< every pixel
  image::difference rest;   ///< without the silhouettes
  std::uint64_t asked = 0;  ///< pixels that are off, at most most_asked
  /// Of these, silhouettes: where each sample of the pixel moves by at most 2^-5 pixels, the double
  /// reference takes values from a to b, and the pixel lies between these in each channel, give or
  /// take what makes a pixel off.
  std::uint64_t silhouettes = 0;
  std::uint64_t off_displayed_explained = 0;  ///< of all.pixels_off_displayed, the silhouettes
  double flip_mean = 0, flip_max = 0;
  std::uint64_t other_bits = 0;  ///< pixels that differ from the strict kernel's in any bit
};

/// Pixels whose channels differ in any bit. The pictures are of one size.
std::uint64_t differing_pixels(const picture& a, const picture& b);

/// What the double reference says of pictures of one scene and size.
class picture_oracle {
 public:
  /// Keeps references; renders the picture on all threads. `check` is called now and then, from
  /// several threads; it may throw to end the work.
  picture_oracle(const scene& s, const reference::tracer<double>& exact, std::uint32_t width,
                 std::uint32_t height, std::uint32_t max_depth, unsigned threads,
                 std::function<void()> check = {});

  /// The bits of reference::tracer<double>::render.
  const picture& expected() const { return expected_; }

  /// Of a picture, beside the strict kernel's. Remembers the values that it found near pixels.
  picture_errors judge(const picture& found, const picture& strict);

 private:
  /// What a pixel may be if its samples move: two pictures of one pixel.
  struct nearby {
    picture least{1, 1}, most{1, 1};
  };
  nearby look_around(std::size_t pixel) const;
  bool is_silhouette(const picture& found, std::size_t pixel) const;

  const scene& scene_;
  const reference::tracer<double>& exact_;
  std::uint32_t max_depth_;
  unsigned threads_;
  std::function<void()> check_;
  picture expected_;
  std::unordered_map<std::size_t, nearby> around_;  ///< by pixel
};

}  // namespace facet::study
