// How far long work has come, with an estimate of what is left.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace facet::cli {

/// On a terminal a bar on stderr, redrawn at most 10 times a second and wiped when the work ends;
/// elsewhere plain lines, one for every tenth but at most one each 2 s. Silent on request.
class progress_bar {
 public:
  progress_bar(std::string doing, bool silent);
  /// Wipes the bar, so that what is said next begins on a clean line.
  ~progress_bar();
  progress_bar(const progress_bar&) = delete;
  progress_bar& operator=(const progress_bar&) = delete;

  void update(std::uint64_t done, std::uint64_t total);

 private:
  using clock = std::chrono::steady_clock;

  void draw(double share, const std::string& left);

  std::string doing_;
  bool silent_, terminal_;
  clock::time_point start_ = clock::now(), last_ = start_;
  bool drawn_ = false;
  int last_tenth_ = 0;
};

}  // namespace facet::cli
