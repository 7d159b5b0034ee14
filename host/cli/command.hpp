// What a subcommand is to main, and which there are: one file each.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace facet::cli {

/// The program's exit codes (README): what a script can tell apart.
enum exit_code : int {
  done = 0,
  usage = 2,
  input = 3,  ///< a scene, a mesh, rays, a picture to compare, or a table of tuned defaults
  device = 4,
  memory = 5,
  output = 6,
  nan = 7,
  unmet = 8,  ///< a case of `facet accuracy` does not meet its goal
  interrupted = 130,
};

/// `run` does the work after parsing, if `app` was the one named; it returns an exit code or
/// throws (main.cpp maps what is thrown).
struct command {
  CLI::App* app;
  std::function<int()> run;
};

command add_render(CLI::App& program);
command add_trace(CLI::App& program);
command add_devices(CLI::App& program);
command add_info(CLI::App& program);
command add_compare(CLI::App& program);
command add_accuracy(CLI::App& program);
command add_sweep(CLI::App& program);
command add_tune(CLI::App& program);

}  // namespace facet::cli
