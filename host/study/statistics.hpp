// What is said of repeated measurements.
#pragma once

#include <span>

namespace facet::study {

struct summary {
  double median = 0, mean = 0;
  double deviation = 0;  ///< standard deviation of the sample (n - 1); 0 for one value
  double least = 0, most = 0;
};

/// All zero without values. The median of an even number is the mean of the middle two.
summary summarize(std::span<const double> values);

}  // namespace facet::study
