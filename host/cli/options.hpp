// Options that several subcommands share, and how their values are checked.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "image/transfer.hpp"
#include "tracer/tracer.hpp"

namespace facet::cli {

/// The command line asks for what cannot be (exit code 2).
class usage_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Accepts whole numbers from least to most; refuses others by naming both.
CLI::Validator whole_number(std::uint64_t least, std::uint64_t most, const std::string& unit);

struct size {
  std::uint32_t width = 0, height = 0;
};

/// An option of the form WxH, both at least 1 and at most `most`.
CLI::Option* add_size(CLI::App& app, const std::string& name, size& target, std::uint32_t most,
                      const std::string& about);

/// What decides where and how rays are traced.
struct tracing_options {
  std::string device;  ///< as runtime::select_device takes it, "serial" or "serial-double"; or ""
  tracer::options tracer;
  bool no_tuning = false;  ///< the built-in defaults, whatever was measured

  bool serial() const { return device == "serial" || device == "serial-double"; }
  bool serial_double() const { return device == "serial-double"; }
};

/// --device; `serial_too`: the serial tracers can be chosen.
void add_device(CLI::App& app, std::string& target, bool serial_too);
/// --geometry, --kernels, --all-features
void add_kernels(CLI::App& app, tracer::options& target);
/// --no-tuning
void add_no_tuning(CLI::App& app, bool& target);
/// --device, --tree, --packets, --geometry, --layout, --no-tuning, --kernels, --all-features
void add_tracing(CLI::App& app, tracing_options& target);

/// Refuses options that mean nothing to the serial tracer: a study must not believe that they did.
void refuse_with_serial(const CLI::App& app, std::initializer_list<const char*> names);

/// --transfer
void add_transfer(CLI::App& app, image::transfer& target, const std::string& about);

}  // namespace facet::cli
