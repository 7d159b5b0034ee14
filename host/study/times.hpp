// Repeated times of one kind, and what is said of them.
#pragma once

#include <vector>

#include "study/statistics.hpp"

namespace facet::study {

/// In milliseconds and in the order in which they were taken.
struct times {
  std::vector<double> ms;
  summary values;
  interval range;  ///< of the median
};

/// Fills in what follows from the samples.
void conclude(times& t, const resampling& r);

}  // namespace facet::study
