#include "image/read.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <string>
#include <vector>

#include "scene/error.hpp"
#include "scene/scene.hpp"

namespace facet::image {
namespace {

transfer curve_of(const OIIO::ImageSpec& spec) {
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  return space == "Linear" || space == "linear" || spec.format.is_floating_point()
             ? transfer::linear
             : transfer::srgb;
}

}  // namespace

picture read_picture(const std::filesystem::path& path, std::optional<transfer> curve) {
  const auto fail = [&](const std::string& what) -> void {
    throw scene_error(path.string(), "", what);
  };
  std::error_code error;
  if (!std::filesystem::exists(path, error)) fail("there is no such file");
  if (!std::filesystem::is_regular_file(path, error)) fail("is not a picture file");

  // Without this a PNG's colours would be multiplied by its alpha.
  OIIO::ImageSpec as_stored;
  as_stored.attribute("oiio:UnassociatedAlpha", 1);
  const auto in = OIIO::ImageInput::open(path.string(), &as_stored);
  if (!in) fail("cannot be read as a picture: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > int(limits::image_side) ||
      spec.height > int(limits::image_side) || spec.depth > 1)
    fail("is " + std::to_string(spec.width) + "x" + std::to_string(spec.height) +
         "; sides from 1 to " + std::to_string(limits::image_side) + " are allowed");

  const int channels = std::min(spec.nchannels, 4);
  picture p(std::uint32_t(spec.width), std::uint32_t(spec.height));
  std::vector<float> stored(std::size_t(spec.width) * std::size_t(spec.height) *
                            std::size_t(channels));
  if (!in->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, stored.data()))
    fail("cannot be read to its end: " + in->geterror());

  const bool curved = curve.value_or(curve_of(spec)) == transfer::srgb;
  const bool grey = channels < 3, has_alpha = channels == 2 || channels == 4;
  for (std::size_t i = 0; i < p.rgba.size() / 4; ++i) {
    const float* from = &stored[i * std::size_t(channels)];
    for (int c = 0; c < 3; ++c) {
      const float value = from[grey ? 0 : c];
      p.rgba[4 * i + std::size_t(c)] = curved ? float(linear_from_srgb(value)) : value;
    }
    p.rgba[4 * i + 3] = has_alpha ? from[channels - 1] : 1;
  }
  return p;
}

}  // namespace facet::image
