// How long a study will take in all, while it runs: each configuration is tried once, which may
// take long (drivers compile), and later timed a number of times.
#pragma once

#include <cstdint>

namespace facet::study {

class forecast {
 public:
  explicit forecast(std::uint64_t configurations) : untried_(configurations) {}

  /// A configuration was tried in `ms`; it will be timed `times` times, for picture_ms each.
  void tried(double ms, double picture_ms, std::uint64_t times);
  /// One was tried in vain: it will not be timed, and says nothing of the others.
  void refused();
  /// It was timed once, in `ms`.
  void timed(double ms, double picture_ms);
  /// It will not be timed so many times more.
  void drop(double picture_ms, std::uint64_t times);

  double spent_ms() const { return spent_; }
  /// What was spent, what is left of the configurations tried, and for each of the others as much
  /// as for one tried so far.
  double total_ms() const;

 private:
  std::uint64_t untried_, tried_ = 0;
  double spent_ = 0, known_ = 0;    ///< known_: left for those tried
  double trying_ = 0, timing_ = 0;  ///< of all that were tried, together
};

}  // namespace facet::study
