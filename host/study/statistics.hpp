// What is said of repeated measurements.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace facet::study {

struct summary {
  double median = 0, mean = 0;
  double deviation = 0;  ///< standard deviation of the sample (n - 1); 0 for one value
  double least = 0, most = 0;
};

/// All zero without values. The median of an even number is the mean of the middle two.
summary summarize(std::span<const double> values);

/// Both ends belong to it.
struct interval {
  double low = 0, high = 0;

  bool overlaps(const interval& other) const { return low <= other.high && other.low <= high; }
  friend bool operator==(const interval&, const interval&) = default;
};

/// How a bootstrap draws. The same values, resampling and seed give the same interval everywhere.
struct resampling {
  std::uint32_t resamples = 2000;
  double level = 0.95;  ///< of the interval, between 0 and 1
  std::uint64_t seed = 1;
};

/// Percentile interval of the median (B. Efron, "Bootstrap methods: another look at the jackknife",
/// Annals of Statistics 7, 1979): the medians of samples drawn from `values` with replacement,
/// without the outermost (1 - level) / 2 at either end. {0, 0} without values.
interval median_interval(std::span<const double> values, const resampling& r);

/// The same of median(above) / median(below), each drawn for itself. The values of `below` are
/// greater than 0. {0, 0} if either has none.
interval ratio_interval(std::span<const double> above, std::span<const double> below,
                        const resampling& r);

/// A measured quantity of which less is better.
struct estimate {
  double median = 0;
  interval range;
};

/// Those that the measurements do not tell from the best: every estimate whose interval overlaps
/// that of the one with the smallest median. Indices in order; empty without estimates.
std::vector<std::size_t> best_set(std::span<const estimate> estimates);

}  // namespace facet::study
