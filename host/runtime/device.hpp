// One OpenCL device, what it can do, and how it is chosen (SYCL 2020, sections 4.6.1 and 4.6.4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/native.hpp"
#include "runtime/platform.hpp"

namespace facet::runtime {

namespace info {
enum class device_type { cpu, gpu, accelerator, other };
}

/// A cheap handle: copies name the same device. Every getter asks the driver.
class device {
 public:
  explicit device(native::device handle) : handle_(handle) {}

  /// The devices of all platforms, flat; empty when there is no platform.
  static std::vector<device> get_devices();

  platform get_platform() const;

  std::string name() const;
  std::string platform_name() const;
  std::string vendor() const;
  std::string driver_version() const;
  std::string version() const;           ///< "OpenCL 3.0 ..."
  std::string opencl_c_version() const;  ///< "OpenCL C 1.2 ..."
  std::vector<std::string> extensions() const;
  bool has_extension(std::string_view name) const;

  info::device_type type() const;
  bool is_cpu() const { return type() == info::device_type::cpu; }
  bool is_gpu() const { return type() == info::device_type::gpu; }
  bool is_accelerator() const { return type() == info::device_type::accelerator; }

  std::uint32_t max_compute_units() const;
  std::uint32_t max_clock_mhz() const;
  std::size_t max_work_group_size() const;
  std::array<std::size_t, 3> max_work_item_sizes() const;
  std::uint64_t global_mem_size() const;     ///< bytes
  std::uint64_t max_mem_alloc_size() const;  ///< bytes of one buffer
  std::uint64_t local_mem_size() const;      ///< bytes a work-group
  bool image_support() const;
  std::size_t image2d_max_width() const;   ///< pixels
  std::size_t image2d_max_height() const;  ///< pixels
  /// Whether -cl-fp32-correctly-rounded-divide-sqrt is honoured.
  bool has_correctly_rounded_divide_sqrt() const;
  bool has_double() const;
  bool has_out_of_order_queues() const;
  std::size_t profiling_timer_resolution() const;  ///< ns a tick
  /// 90 for sm_90, and so on; 0 where the driver is not NVIDIA's.
  std::uint32_t nvidia_compute_capability() const;

  native::device get() const noexcept { return handle_; }
  friend bool operator==(const device&, const device&) = default;

 private:
  native::device handle_;
};

/// A selector scores a device; the highest score wins, the first of equals; negative: never.
using device_selector = std::function<int(const device&)>;

int default_selector_v(const device& d);  ///< a GPU, else an accelerator, else whatever there is
int cpu_selector_v(const device& d);
int gpu_selector_v(const device& d);

/// Throws errc::runtime when no device is acceptable, with the list of those there are; with none
/// at all, with what provides one.
device select_device(const device_selector& selector);

/// `text` is an index into device::get_devices(), or a part of a device's or its platform's name in
/// any case (the first that matches is taken; a device's name goes before a platform's); "" means
/// default_selector_v. Throws as above.
device select_device(std::string_view text);
inline device select_device(const char* text) { return select_device(std::string_view(text)); }
inline device select_device(const std::string& text) {
  return select_device(std::string_view(text));
}

/// "0: NAME (PLATFORM)", a line a device.
std::string list_devices(const std::vector<device>& devices);

}  // namespace facet::runtime
