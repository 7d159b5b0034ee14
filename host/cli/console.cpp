#include "cli/console.hpp"

#include <CLI/CLI.hpp>
#include <cstdio>

namespace facet::cli {
namespace {

std::string number(double value, int digits, const char* unit) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f %s", digits, value, unit);
  return text;
}

}  // namespace

void console::say(const std::string& text) const {
  if (!quiet) std::fprintf(stderr, "facet: %s\n", text.c_str());
}

void console::detail(const std::string& text) const {
  if (detailed) say(text);
}

void console::notes(const std::vector<std::string>& lines) const {
  for (const std::string& line : lines) say("note: " + line);
}

void add_console(CLI::App& app, console& target) {
  CLI::Option* quiet = app.add_flag("-q,--quiet", target.quiet, "Say nothing but errors");
  app.add_flag("-v,--verbose", target.detailed, "Say what was chosen and what it took")
      ->excludes(quiet);
}

std::string duration_text(double milliseconds) {
  if (milliseconds < 1000) return number(milliseconds, milliseconds < 10 ? 2 : 1, "ms");
  if (milliseconds < 600e3) return number(milliseconds / 1000, 1, "s");
  return number(milliseconds / 60e3, 0, "min");
}

std::string bytes_text(double bytes) {
  if (bytes < 1024) return number(bytes, 0, "bytes");
  if (bytes < 0x1p20) return number(bytes / 1024, 1, "KiB");
  if (bytes < 0x1p30) return number(bytes / 0x1p20, 1, "MiB");
  return number(bytes / 0x1p30, 1, "GiB");
}

}  // namespace facet::cli
