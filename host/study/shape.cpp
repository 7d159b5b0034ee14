#include "study/shape.hpp"

#include <algorithm>
#include <charconv>

namespace facet::study {
namespace {

constexpr std::uint32_t longest_side = 1u << 16;

bool to_side(std::string_view text, std::uint32_t& side) {
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, side);
  return error == std::errc() && stop == end && side >= 1 && side <= longest_side;
}

shape parse_one(std::string_view word) {
  if (word == "driver") return {};
  shape s;
  const std::size_t x = word.find('x');
  if (x == word.npos || !to_side(word.substr(0, x), s.width) ||
      !to_side(word.substr(x + 1), s.height))
    throw shape_error("found \"" + std::string(word) +
                      "\"; allowed is \"all\", or a list with commas of WIDTHxHEIGHT, like 16x4, "
                      "both from 1 to " +
                      std::to_string(longest_side) + ", and \"driver\"");
  return s;
}

}  // namespace

std::string shape::text() const {
  return is_driver() ? "driver" : std::to_string(width) + "x" + std::to_string(height);
}

std::vector<shape> all_shapes(std::uint64_t most_items) {
  std::vector<shape> all;
  for (std::uint64_t items = 1; items <= most_items; items *= 2)
    for (std::uint64_t width = 1; width <= items; width *= 2)
      if (width <= longest_side && items / width <= longest_side)
        all.push_back({std::uint32_t(width), std::uint32_t(items / width)});
  all.push_back({});
  return all;
}

std::vector<shape> parse_shapes(std::string_view text, std::uint64_t most_items) {
  if (text == "all") return all_shapes(most_items);
  std::vector<shape> shapes;
  for (;;) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const shape s = parse_one(text.substr(0, comma));
    if (std::find(shapes.begin(), shapes.end(), s) != shapes.end())
      throw shape_error("found " + s.text() + " twice; name each shape once");
    shapes.push_back(s);
    if (comma == text.size()) return shapes;
    text.remove_prefix(comma + 1);
  }
}

}  // namespace facet::study
