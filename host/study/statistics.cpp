#include "study/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace facet::study {
namespace {

double median_of_sorted(std::span<const double> sorted) {
  const std::size_t n = sorted.size();
  return n % 2 ? sorted[n / 2] : (sorted[n / 2 - 1] + sorted[n / 2]) / 2;
}

/// Medians of samples drawn with replacement. The standard's distributions may differ from library
/// to library, its engines may not: places are remainders, biased by less than 2^-40.
class resampled_medians {
 public:
  explicit resampled_medians(std::span<const double> values)
      : sorted_(values.begin(), values.end()), places_(values.size()), drawn_(values.size()) {
    std::sort(sorted_.begin(), sorted_.end());
  }

  double next(std::mt19937_64& random) {
    for (std::size_t& p : places_) p = std::size_t(random() % sorted_.size());
    std::sort(places_.begin(), places_.end());
    for (std::size_t i = 0; i < places_.size(); ++i) drawn_[i] = sorted_[places_[i]];
    return median_of_sorted(drawn_);
  }

 private:
  std::vector<double> sorted_;
  std::vector<std::size_t> places_;
  std::vector<double> drawn_;
};

interval percentiles(std::vector<double> drawn, double level) {
  if (drawn.empty()) return {};
  std::sort(drawn.begin(), drawn.end());
  const double outside = (1 - level) / 2 * double(drawn.size());
  const auto cut = std::min(std::size_t(std::max(outside, 0.0)), (drawn.size() - 1) / 2);
  return {drawn[cut], drawn[drawn.size() - 1 - cut]};
}

}  // namespace

summary summarize(std::span<const double> values) {
  if (values.empty()) return {};
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t n = sorted.size();
  summary s;
  s.least = sorted.front();
  s.most = sorted.back();
  s.median = median_of_sorted(sorted);
  s.mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / double(n);
  double squares = 0;
  for (double v : sorted) squares += (v - s.mean) * (v - s.mean);
  s.deviation = n > 1 ? std::sqrt(squares / double(n - 1)) : 0;
  return s;
}

interval median_interval(std::span<const double> values, const resampling& r) {
  if (values.empty()) return {};
  std::mt19937_64 random(r.seed);
  resampled_medians medians(values);
  std::vector<double> drawn(r.resamples);
  for (double& d : drawn) d = medians.next(random);
  return percentiles(std::move(drawn), r.level);
}

interval ratio_interval(std::span<const double> above, std::span<const double> below,
                        const resampling& r) {
  if (above.empty() || below.empty()) return {};
  std::mt19937_64 random(r.seed);
  resampled_medians numerators(above), denominators(below);
  std::vector<double> drawn(r.resamples);
  for (double& d : drawn) {
    const double numerator = numerators.next(random);
    d = numerator / denominators.next(random);
  }
  return percentiles(std::move(drawn), r.level);
}

std::vector<std::size_t> best_set(std::span<const estimate> estimates) {
  std::vector<std::size_t> set;
  const auto best =
      std::min_element(estimates.begin(), estimates.end(),
                       [](const estimate& a, const estimate& b) { return a.median < b.median; });
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (estimates[i].range.overlaps(best->range)) set.push_back(i);
  return set;
}

}  // namespace facet::study
