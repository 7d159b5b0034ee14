#include "study/tuning_result.hpp"

#include <cmath>
#include <stdexcept>

namespace facet::study {

relative_time relative_to(const std::vector<std::vector<double>>& kept,
                          const std::vector<std::vector<double>>& own, const resampling& r) {
  relative_time t;
  const std::size_t rounds = own.empty() ? 0 : own[0].size();
  for (std::size_t k = 0; k < rounds; ++k) {
    double logarithms = 0;
    for (std::size_t w = 0; w < own.size(); ++w) {
      const double mine = own.at(w).at(k), theirs = kept.at(w).at(k);
      if (!(mine > 0 && theirs > 0))
        throw std::invalid_argument("a time of a workload is not greater than 0");
      logarithms += std::log(mine / theirs);
    }
    t.rounds.push_back(std::exp(logarithms / double(own.size())));
  }
  t.median = summarize(t.rounds).median;
  t.range = median_interval(t.rounds, r);
  return t;
}

bool is_faster(const relative_time& t, const tuning_settings& s) {
  return !t.rounds.empty() && t.range.high < 1 - s.margin;
}

std::optional<std::uint32_t> challenger_of(const choice_result& c, const tuning_settings& s) {
  std::optional<std::uint32_t> best;
  for (std::uint32_t k = 1; k < c.trials.size(); ++k) {
    const relative_time& t = c.trials[k].relative;
    if (is_faster(t, s) && (!best || t.median < c.trials[*best].relative.median)) best = k;
  }
  return best;
}

std::uint32_t taken_of(const choice_result& c, const tuning_settings& s) {
  return c.challenger && is_faster(c.confirmation, s) ? *c.challenger : 0;
}

}  // namespace facet::study
