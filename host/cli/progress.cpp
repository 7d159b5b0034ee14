#include "cli/progress.hpp"

#include <unistd.h>

#include <cstdio>

#include "cli/console.hpp"

namespace facet::cli {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_after = 100ms;  // on a terminal
constexpr auto line_after = 2s;       // elsewhere
constexpr int bar_width = 30;

}  // namespace

progress_bar::progress_bar(std::string doing, bool silent)
    : doing_(std::move(doing)), silent_(silent), terminal_(::isatty(STDERR_FILENO) == 1) {}

progress_bar::~progress_bar() {
  if (drawn_) std::fputs("\r\033[K", stderr);
}

void progress_bar::update(std::uint64_t done, std::uint64_t total) {
  const auto now = clock::now();
  if (silent_ || done == 0 || done >= total) return;
  if (now - last_ < (terminal_ ? clock::duration(redraw_after) : clock::duration(line_after)))
    return;
  const double share = double(done) / double(total);
  const double spent = std::chrono::duration<double, std::milli>(now - start_).count();
  const std::string left = "about " + duration_text(spent * (1 - share) / share) + " left";
  if (terminal_) {
    draw(share, left);
  } else {
    if (int(share * 10) <= last_tenth_) return;
    last_tenth_ = int(share * 10);
    std::fprintf(stderr, "facet: %s %d%%, %s\n", doing_.c_str(), int(share * 100), left.c_str());
  }
  last_ = now;
}

void progress_bar::draw(double share, const std::string& left) {
  std::string bar(std::size_t(share * bar_width), '=');
  bar.resize(bar_width, ' ');
  std::fprintf(stderr, "\r%s [%s] %3d%%, %s\033[K", doing_.c_str(), bar.c_str(), int(share * 100),
               left.c_str());
  std::fflush(stderr);
  drawn_ = true;
}

}  // namespace facet::cli
