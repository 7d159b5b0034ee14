// What every row needs of the machine: the clock, a file.
#pragma once

#include <functional>
#include <string>

namespace facet::bench {

/// Seconds that one call takes, by the steady clock.
double seconds(const std::function<void()>& work);

/// Throws std::runtime_error, naming the file, if it cannot be written.
void write_text(const std::string& path, const std::string& text);

}  // namespace facet::bench
