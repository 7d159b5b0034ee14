#include "cli/device_choice.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace facet::cli {
namespace {

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return text;
}

bool is_index(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

/// How many devices a part of a name stands for.
std::ptrdiff_t matches(const std::vector<runtime::device>& devices, const std::string& text) {
  const std::string part = lower(text);
  return std::count_if(devices.begin(), devices.end(), [&](const runtime::device& d) {
    return lower(d.name()).find(part) != std::string::npos ||
           lower(d.platform_name()).find(part) != std::string::npos;
  });
}

runtime::device first_choice(const std::vector<runtime::device>& devices) {
  const auto gpu = std::find_if(devices.begin(), devices.end(),
                                [](const runtime::device& d) { return d.is_gpu(); });
  return gpu == devices.end() ? devices.front() : *gpu;
}

}  // namespace

void no_device() {
  throw device_error(
      "no OpenCL device was found\n"
      "The package pocl-opencl-icd makes one of the CPU; a GPU's driver brings its own.\n"
      "Without any: --device serial traces on one CPU thread.");
}

runtime::device choose_device(const std::string& text, const console& out) {
  const std::vector<runtime::device> devices = runtime::device::get_devices();
  if (devices.empty()) no_device();
  const runtime::device chosen =
      text.empty() ? first_choice(devices) : runtime::select_device(text);
  if (!text.empty() && !is_index(text) && matches(devices, text) > 1)
    out.detail(std::to_string(matches(devices, text)) + " devices match \"" + text +
               "\"; the first is taken");
  out.detail("device: " + chosen.name() + " (" + chosen.platform_name() + ")");
  return chosen;
}

}  // namespace facet::cli
