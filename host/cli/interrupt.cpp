#include "cli/interrupt.hpp"

#include <csignal>
#include <string>

namespace facet::cli {
namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may set it");

extern "C" void on_signal(int number) {
  // The second signal meets the system's own handling, which ends the program.
  std::signal(number, SIG_DFL);
  flag.store(true);
}

}  // namespace

void watch_interrupts() {
  // Whoever started the program with SIGINT ignored (nohup, a background job) meant it.
  for (const int number : {SIGINT, SIGTERM})
    if (std::signal(number, on_signal) == SIG_IGN) std::signal(number, SIG_IGN);
}

const std::atomic<bool>& interrupt_flag() { return flag; }

void stop_if_interrupted(const char* doing) {
  if (flag.load())
    throw interrupted_error(std::string("interrupted while ") + doing + "; nothing was saved");
}

}  // namespace facet::cli
