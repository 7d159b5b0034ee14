// The program `facet`: which subcommand, and which exit code for what went wrong.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

#include "cli/command.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/options.hpp"
#include "image/output.hpp"
#include "image/transfer.hpp"
#include "runtime/error.hpp"
#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "study/tuning_table.hpp"

namespace {

using namespace facet;

int fail(cli::exit_code code, const std::string& message) {
  std::fprintf(stderr, "facet: %s\n", message.c_str());
  return code;
}

/// Maps the exception under way to its exit code, and says it on stderr.
int explain() {
  try {
    throw;
  } catch (const cli::usage_error& e) {
    return fail(cli::usage, e.what());
  } catch (const scene_error& e) {
    return fail(cli::input, e.what());
  } catch (const study::tuning_error& e) {
    return fail(cli::input, e.what());
  } catch (const image::output_error& e) {
    return fail(cli::output, e.what());
  } catch (const image::nan_error& e) {
    return fail(cli::nan, std::string(e.what()) + "; nothing was written");
  } catch (const cli::interrupted_error& e) {
    return fail(cli::interrupted, e.what());
  } catch (const cli::device_error& e) {
    return fail(cli::device, e.what());
  } catch (const cli::memory_error& e) {
    return fail(cli::memory, e.what());
  } catch (const runtime::exception& e) {
    const bool no_memory = e.code() == runtime::errc::memory_allocation;
    return fail(no_memory ? cli::memory : cli::device, e.what());
  } catch (const std::bad_alloc&) {
    return fail(cli::memory, "out of memory; try a smaller picture or scene");
  } catch (const std::length_error&) {
    return fail(cli::memory, "out of memory: something is too large to be held at all");
  } catch (const std::exception& e) {
    return fail(cli::device, std::string("unexpected error: ") + e.what());
  }
}

/// "render" misspelt deserves a better answer than that a command is missing.
std::string explain_usage(const CLI::ParseError& e, const std::vector<cli::command>& commands,
                          int argc, char** argv) {
  std::string named = "facet";
  std::vector<std::string> known;
  for (const auto& c : commands) {
    known.push_back(c.app->get_name());
    if (c.app->parsed()) named += " " + c.app->get_name();
  }
  const bool unknown = named == "facet" && argc > 1 && argv[1][0] != '-';
  return (unknown ? unknown_name("command", argv[1], known) : std::string(e.what())) + "\n`" +
         named + " --help` lists the options";
}

int run(int argc, char** argv) {
  CLI::App program{"Facet, an OpenCL ray tracer that says how fast it was, and how wrong."};
  program.name("facet");
  program.set_version_flag("--version", "facet " FACET_VERSION);
  program.require_subcommand(1);
  program.footer(
      "Exit codes: 0 done, 2 usage, 3 scene or other input, 4 device or driver, 5 out of memory,\n"
      "6 output, 7 the picture holds NaN, 8 a hard case fails its goal, 130 interrupted.\n"
      "`facet COMMAND --help` says more.");
  const std::vector<cli::command> commands{cli::add_render(program),  cli::add_trace(program),
                                           cli::add_devices(program), cli::add_info(program),
                                           cli::add_compare(program), cli::add_accuracy(program),
                                           cli::add_sweep(program),   cli::add_tune(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& e) {  // --help, --version
    return program.exit(e);
  } catch (const CLI::ParseError& e) {
    return fail(cli::usage, explain_usage(e, commands, argc, argv));
  }
  cli::watch_interrupts();
  for (const auto& c : commands)
    if (c.app->parsed()) return c.run();
  return cli::done;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (...) {
    return explain();
  }
}
