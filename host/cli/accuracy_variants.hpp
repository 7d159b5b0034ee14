// facet accuracy --variants: speed against error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"

namespace facet::cli {

struct variants_request {
  std::string scene, device, json;
  std::optional<std::vector<std::string>> only;  ///< names; strict joins them
  size picture;                                  ///< 0 x 0: by default
  unsigned repeats = 10;
  std::uint32_t seed = 1;
};

/// Returns an exit code, or throws what main.cpp maps.
int run_accuracy_variants(const variants_request& request, const console& say);

}  // namespace facet::cli
