// Times of repeated runs, and what is said of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace facet::bench {

/// Seconds that one call takes, by the steady clock.
double seconds(const std::function<void()>& work);

struct spread {
  double median, least, most;
};
/// Of at least one value.
spread spread_of(std::vector<double> values);

/// The CPU's model from the system, or "unknown".
std::string cpu_name();

/// Throws std::runtime_error, naming the file, if it cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace facet::bench
