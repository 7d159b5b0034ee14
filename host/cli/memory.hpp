// Host memory is checked before it is asked for: an overcommitted allocation would not fail but
// have the program killed later.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace facet::cli {

/// Exit code 5.
class memory_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Bytes that this process could ever hold: the machine's memory, or its own limit if lower.
std::uint64_t host_memory();

/// Throws memory_error, naming `what` and both figures, if `bytes` exceed host_memory().
void require_memory(std::uint64_t bytes, const std::string& what);

}  // namespace facet::cli
