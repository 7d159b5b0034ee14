#include "study/forecast.hpp"

#include <algorithm>

namespace facet::study {

void forecast::tried(double ms, double picture_ms, std::uint64_t times) {
  if (untried_ > 0) --untried_;
  ++tried_;
  spent_ += ms;
  trying_ += ms;
  timing_ += picture_ms * double(times);
  known_ += picture_ms * double(times);
}

void forecast::refused() {
  if (untried_ > 0) --untried_;
}

void forecast::timed(double ms, double picture_ms) {
  spent_ += ms;
  drop(picture_ms, 1);
}

void forecast::drop(double picture_ms, std::uint64_t times) {
  known_ = std::max(0.0, known_ - picture_ms * double(times));
}

double forecast::total_ms() const {
  const double each = tried_ ? (trying_ + timing_) / double(tried_) : 0;
  return spent_ + known_ + double(untried_) * each;
}

}  // namespace facet::study
