// The file of speed against error: format "facet-variants", version 1
// (bench/facet-variants.schema.json).
#pragma once

#include <string>

#include "study/variant_result.hpp"

namespace facet::study {

/// What has no value (the median of no samples, the PSNR of equal pictures) is null.
std::string to_json(const variants_result& result);

}  // namespace facet::study
