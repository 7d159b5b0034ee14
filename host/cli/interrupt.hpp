// Ctrl-C: the work under way ends at its next check, a second one ends the program at once.
#pragma once

#include <atomic>
#include <stdexcept>

namespace facet::cli {

/// The message says what was saved (exit code 130).
class interrupted_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// From here on SIGINT and SIGTERM set `interrupt_flag`.
void watch_interrupts();

const std::atomic<bool>& interrupt_flag();

/// Throws interrupted_error if the flag is set; `doing` names the work that ends here.
void stop_if_interrupted(const char* doing);

}  // namespace facet::cli
