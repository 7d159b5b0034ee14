// What the study of speed against error says on stdout.
#pragma once

#include "study/variant_result.hpp"

namespace facet::cli {

/// A line for each variant: time and rate of the picture, rate of rays traced alone, wrong hits per
/// million, error of t, errors of the linear and of the displayed picture. Then what the columns
/// mean.
void print_table(const study::variants_result& r);

}  // namespace facet::cli
