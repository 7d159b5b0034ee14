// What a sweep says on stdout.
#pragma once

#include "study/sweep_result.hpp"

namespace facet::cli {

/// Medians of kernel time with their intervals and speed-ups: the serial reference, the first
/// shape, the driver's choice, the fastest few of the best, and which shapes were refused.
void print_table(const study::experiment_result& e);

}  // namespace facet::cli
