// What the program says on stderr, and when: stdout is for results.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace facet::cli {

struct console {
  bool quiet = false;     ///< errors alone
  bool detailed = false;  ///< choices and times, too

  /// A line beginning "facet: ", unless quiet.
  void say(const std::string& text) const;
  /// The same with -v alone.
  void detail(const std::string& text) const;
  void notes(const std::vector<std::string>& lines) const;
};

/// --quiet, -v
void add_console(CLI::App& app, console& target);

/// "1.23 s", "45.6 ms"
std::string duration_text(double milliseconds);
/// "1.2 GiB", "640 bytes"
std::string bytes_text(double bytes);

}  // namespace facet::cli
