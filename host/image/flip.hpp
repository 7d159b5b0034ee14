// How different two pictures look to somebody who flips between them: LDR-FLIP of P. Andersson, J.
// Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild, "FLIP: A Difference
// Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics and Interactive
// Techniques 3(2), 2020 (HPG).
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "scene/picture.hpp"

namespace facet::image {

/// The paper's viewer: 0.7 m before a screen that is 0.7 m wide and has 3840 pixels; 67.02.
inline constexpr double usual_pixels_per_degree = 3840 * std::numbers::pi / 180;

struct flip_map {
  std::uint32_t width = 0, height = 0;
  std::vector<float> error;  ///< by pixel, row by row from the top: 0 to 1
  double mean = 0, max = 0;

  float at(std::uint32_t x, std::uint32_t y) const { return error[std::size_t(y) * width + x]; }
};

/// Of the pictures as a screen shows them: clamped, sRGB, eight bits, alpha left out. The order of
/// the two does not matter; equal ones have 0 everywhere. Throws std::invalid_argument, naming both
/// sizes, if they differ.
flip_map flip(const picture& a, const picture& b,
              double pixels_per_degree = usual_pixels_per_degree);

}  // namespace facet::image
