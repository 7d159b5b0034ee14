// The shape of a work-group: what the sweep varies.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace facet::study {

/// Work-items along x and y. 0 x 0 is no shape but a question: what the driver would choose, given
/// no local size.
struct shape {
  std::uint32_t width = 0, height = 0;

  bool is_driver() const { return width == 0; }
  std::uint64_t items() const { return std::uint64_t(width) * height; }
  /// "16x4", or "driver".
  std::string text() const;

  friend bool operator==(const shape&, const shape&) = default;
};

/// A text names no shapes; the message says what was found and what is allowed.
class shape_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Every width and height that is a power of two with at most `most_items` in a group: squares,
/// rows (height 1), columns (width 1) and the rectangles between; from 1x1 on, by their number of
/// work-items and then by width; at the end the driver's choice.
std::vector<shape> all_shapes(std::uint64_t most_items);

/// "all", or shapes separated by commas: "8x8,16x4,driver"; sides are 1 to 2^16. Throws
/// shape_error, also if one is named twice.
std::vector<shape> parse_shapes(std::string_view text, std::uint64_t most_items);

}  // namespace facet::study
