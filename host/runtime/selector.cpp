// How a device is chosen: by score, by index, by name.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

#include "runtime/device.hpp"
#include "runtime/error.hpp"

namespace facet::runtime {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return out;
}

std::optional<std::size_t> index_in(std::string_view text) {
  std::size_t index = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, index);
  if (error != std::errc() || stop != end) return std::nullopt;
  return index;
}

const device* find(const std::vector<device>& devices, std::string_view text) {
  if (const auto index = index_in(text); index && *index < devices.size()) return &devices[*index];
  const std::string part = lower(text);
  for (const device& d : devices)
    if (lower(d.name()).find(part) != std::string::npos) return &d;
  for (const device& d : devices)
    if (lower(d.platform_name()).find(part) != std::string::npos) return &d;
  return nullptr;
}

std::vector<device> some_devices() {
  std::vector<device> devices = device::get_devices();
  if (devices.empty())
    throw exception(errc::runtime,
                    "there is no OpenCL device on this machine; the package pocl-opencl-icd "
                    "provides one on a CPU, and a GPU's driver provides one for the GPU");
  return devices;
}

}  // namespace

int default_selector_v(const device& d) {
  switch (d.type()) {
    case info::device_type::gpu:
      return 3;
    case info::device_type::accelerator:
      return 2;
    case info::device_type::cpu:
    case info::device_type::other:
      break;
  }
  return 1;
}

int cpu_selector_v(const device& d) { return d.is_cpu() ? 1 : -1; }
int gpu_selector_v(const device& d) { return d.is_gpu() ? 1 : -1; }

device select_device(const device_selector& selector) {
  const std::vector<device> devices = some_devices();
  const device* best = nullptr;
  int best_score = -1;
  for (const device& d : devices) {
    const int score = selector(d);
    if (score > best_score) best = &d, best_score = score;
  }
  if (!best)
    throw exception(errc::runtime, "the selector accepts none of the devices there are:\n" +
                                       list_devices(devices));
  return *best;
}

device select_device(std::string_view text) {
  if (text.empty()) return select_device(device_selector(default_selector_v));
  const std::vector<device> devices = some_devices();
  const device* found = find(devices, text);
  if (!found)
    throw exception(errc::runtime, "no device matches '" + std::string(text) +
                                       "'; give an index or a part of a name of these:\n" +
                                       list_devices(devices));
  return *found;
}

std::string list_devices(const std::vector<device>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (i) text += '\n';
    text += std::to_string(i) + ": " + devices[i].name() + " (" + devices[i].platform_name() + ")";
  }
  return text;
}

}  // namespace facet::runtime
