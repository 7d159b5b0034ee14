// Which ways to trace the study of speed against error measures.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracer/tracer.hpp"

namespace facet::study {

struct listed_variant {
  std::string name;    ///< one word: "fast-math"
  std::string family;  ///< what it has in common with others: "arithmetic"
  std::string about;
  tracer::options options{};
  std::uint32_t max_depth = 0;  ///< of its pictures
  /// Hits and pictures are promised to be those of "strict", bit for bit.
  bool is_exact = false;
  /// Only which rays follow a hit is another: what a ray meets is decided as in "strict".
  bool is_shading_only = false;
};

/// "strict" first, then all others, for a scene of that depth: exact ones (images, no tree, all
/// features), other arithmetic, other triangle tests, fewer bounces, and rays cut off that weigh
/// little. A new tree or layout is a row more.
std::vector<listed_variant> variant_list(std::uint32_t max_depth);

}  // namespace facet::study
