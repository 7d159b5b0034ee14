// Repeated times of one kind.
#pragma once

#include <vector>

#include "study/statistics.hpp"

namespace facet::study {

/// In milliseconds and in the order in which they were taken.
struct times {
  std::vector<double> ms;
  summary values;
  interval range;  ///< of the median

  /// Fills what follows from the samples.
  void conclude(const resampling& r) {
    values = summarize(ms);
    range = median_interval(ms, r);
  }
};

}  // namespace facet::study
