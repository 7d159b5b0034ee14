// The file of a sweep: format "facet-sweep", version 1 (bench/facet-sweep.schema.json).
#pragma once

#include <string>

#include "study/sweep_result.hpp"

namespace facet::study {

/// What has no value (the median of no samples, the speed-up without the serial reference) is null.
std::string to_json(const sweep_result& result);

}  // namespace facet::study
