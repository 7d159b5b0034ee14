// facet devices: what --device can choose from.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <vector>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/tuning_file.hpp"
#include "study/tuning_table.hpp"

namespace facet::cli {
namespace {

const char* type_of(const runtime::device& d) {
  return d.is_gpu() ? "GPU" : d.is_cpu() ? "CPU" : d.is_accelerator() ? "accelerator" : "other";
}

/// The user's table; one that cannot be used is told of, and the devices are listed all the same.
study::tuning_table table_of_user() {
  const std::filesystem::path path = tuning_path();
  if (path.empty()) return {};
  try {
    return study::read_tuning_table(path);
  } catch (const study::tuning_error& e) {
    console{}.say("note: " + std::string(e.what()));
    return {};
  }
}

int run() {
  const std::vector<runtime::device> devices = runtime::device::get_devices();
  if (devices.empty()) no_device();
  const study::tuning_table table = table_of_user();
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const runtime::device& d = devices[i];
    std::printf("%zu  %s\n", i, d.name().c_str());
    std::printf("   %s, %s, %u compute units, %s, driver %s\n", type_of(d),
                d.platform_name().c_str(), unsigned(d.max_compute_units()),
                bytes_text(double(d.global_mem_size())).c_str(), d.driver_version().c_str());
    if (const study::tuned_entry* e = table.find(d))
      std::printf("   tuned %s (`facet tune --show`)\n", e->date.c_str());
    else
      std::printf("   built-in defaults (`facet tune` measures better ones)\n");
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
