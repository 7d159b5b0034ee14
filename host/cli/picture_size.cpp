#include "cli/picture_size.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "scene/scene.hpp"

namespace facet::cli {
namespace {

std::uint32_t other_side(double given, double from, double to, const char* name) {
  const double side = std::max(1.0, std::round(given * to / from));
  if (side > limits::image_side)
    throw usage_error(std::string("the picture's ") + name + " would be " +
                      std::to_string(std::uint64_t(side)) + " pixels; at most " +
                      std::to_string(limits::image_side) + " are allowed");
  return std::uint32_t(side);
}

}  // namespace

void add_picture_size(CLI::App& app, std::uint32_t& width, std::uint32_t& height) {
  app.add_option("--width", width, "Pixels; alone it keeps the scene's aspect ratio")
      ->type_name("N")
      ->check(whole_number(1, limits::image_side, "pixels"));
  app.add_option("--height", height, "Pixels; alone it keeps the scene's aspect ratio")
      ->type_name("N")
      ->check(whole_number(1, limits::image_side, "pixels"));
}

size picture_size(size asked, size own) {
  if (asked.width && asked.height) return asked;
  if (asked.width) return {asked.width, other_side(asked.width, own.width, own.height, "height")};
  if (asked.height) return {other_side(asked.height, own.height, own.width, "width"), asked.height};
  return own;
}

}  // namespace facet::cli
