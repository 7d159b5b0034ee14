#include "study/times.hpp"

namespace facet::study {

void conclude(times& t, const resampling& r) {
  t.values = summarize(t.ms);
  t.range = median_interval(t.ms, r);
}

}  // namespace facet::study
