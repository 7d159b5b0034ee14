// facet devices: what --device can choose from.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"

namespace facet::cli {
namespace {

const char* type_of(const runtime::device& d) {
  return d.is_gpu() ? "GPU" : d.is_cpu() ? "CPU" : d.is_accelerator() ? "accelerator" : "other";
}

int run() {
  const std::vector<runtime::device> devices = runtime::device::get_devices();
  if (devices.empty()) no_device();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const runtime::device& d = devices[i];
    std::printf("%zu  %s\n", i, d.name().c_str());
    std::printf("   %s, %s, %u compute units, %s, driver %s\n", type_of(d),
                d.platform_name().c_str(), unsigned(d.max_compute_units()),
                bytes_text(double(d.global_mem_size())).c_str(), d.driver_version().c_str());
  }
  return done;
}

}  // namespace

command add_devices(CLI::App& program) {
  auto* app = program.add_subcommand("devices", "The OpenCL devices of this machine");
  app->footer("Choose one by --device, with its index or a part of its name.");
  return {app, [] { return run(); }};
}

}  // namespace facet::cli
