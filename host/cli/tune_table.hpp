// What tuning prints on stdout.
#pragma once

#include <string>

#include "study/tuning_result.hpp"

namespace facet::cli {

/// A line for the choice, with what was taken, and one for each value: time relative to the value
/// kept so far, with its interval.
void print_choice(const study::choice_result& c);

/// All choices by name, those that differ from `usual` with what that is.
void print_values(const tracer::choices& values, const tracer::choices& usual);

}  // namespace facet::cli
