#include "tracer/program_set.hpp"

#include <algorithm>

namespace facet::tracer {

void program_set::add(const runtime::program& p) {
  const auto is_p = [&](const runtime::program& other) { return other.get() == p.get(); };
  if (std::none_of(all_.begin(), all_.end(), is_p)) all_.push_back(p);
}

double program_set::build_ms() const {
  double sum = 0;
  for (const runtime::program& p : all_) sum += p.build_ms();
  return sum;
}

}  // namespace facet::tracer
