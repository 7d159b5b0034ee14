#include "runtime/device.hpp"

#include <sstream>

#include "runtime/opencl.hpp"

namespace facet::runtime {
namespace {

template <cl_device_info Info>
auto ask(native::device d) {
  return detail::call([&] { return cl::Device(d, true).getInfo<Info>(); });
}

}  // namespace

std::vector<device> device::get_devices() {
  std::vector<device> all;
  for (const platform& p : platform::get_platforms()) {
    const std::vector<device> own = p.get_devices();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

platform device::get_platform() const { return platform(ask<CL_DEVICE_PLATFORM>(handle_)); }

std::string device::name() const { return ask<CL_DEVICE_NAME>(handle_); }
std::string device::platform_name() const { return get_platform().name(); }
std::string device::vendor() const { return ask<CL_DEVICE_VENDOR>(handle_); }
std::string device::driver_version() const { return ask<CL_DRIVER_VERSION>(handle_); }
std::string device::version() const { return ask<CL_DEVICE_VERSION>(handle_); }
std::string device::opencl_c_version() const { return ask<CL_DEVICE_OPENCL_C_VERSION>(handle_); }

std::vector<std::string> device::extensions() const {
  std::istringstream words(ask<CL_DEVICE_EXTENSIONS>(handle_));
  std::vector<std::string> list;
  for (std::string word; words >> word;) list.push_back(word);
  return list;
}

bool device::has_extension(std::string_view name) const {
  for (const std::string& e : extensions())
    if (e == name) return true;
  return false;
}

info::device_type device::type() const {
  const cl_device_type bits = ask<CL_DEVICE_TYPE>(handle_);
  if (bits & CL_DEVICE_TYPE_GPU) return info::device_type::gpu;
  if (bits & CL_DEVICE_TYPE_CPU) return info::device_type::cpu;
  if (bits & CL_DEVICE_TYPE_ACCELERATOR) return info::device_type::accelerator;
  return info::device_type::other;
}

std::uint32_t device::max_compute_units() const {
  return ask<CL_DEVICE_MAX_COMPUTE_UNITS>(handle_);
}
std::uint32_t device::max_clock_mhz() const { return ask<CL_DEVICE_MAX_CLOCK_FREQUENCY>(handle_); }
std::size_t device::max_work_group_size() const {
  return ask<CL_DEVICE_MAX_WORK_GROUP_SIZE>(handle_);
}
std::array<std::size_t, 3> device::max_work_item_sizes() const {
  const auto sizes = ask<CL_DEVICE_MAX_WORK_ITEM_SIZES>(handle_);
  return {sizes.at(0), sizes.at(1), sizes.at(2)};
}
std::uint64_t device::global_mem_size() const { return ask<CL_DEVICE_GLOBAL_MEM_SIZE>(handle_); }
std::uint64_t device::max_mem_alloc_size() const {
  return ask<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(handle_);
}
std::uint64_t device::local_mem_size() const { return ask<CL_DEVICE_LOCAL_MEM_SIZE>(handle_); }
bool device::image_support() const { return ask<CL_DEVICE_IMAGE_SUPPORT>(handle_) != 0; }
std::size_t device::image2d_max_width() const { return ask<CL_DEVICE_IMAGE2D_MAX_WIDTH>(handle_); }
std::size_t device::image2d_max_height() const {
  return ask<CL_DEVICE_IMAGE2D_MAX_HEIGHT>(handle_);
}
bool device::has_correctly_rounded_divide_sqrt() const {
  return (ask<CL_DEVICE_SINGLE_FP_CONFIG>(handle_) & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
}
bool device::has_double() const { return ask<CL_DEVICE_DOUBLE_FP_CONFIG>(handle_) != 0; }
bool device::has_out_of_order_queues() const {
  return (ask<CL_DEVICE_QUEUE_PROPERTIES>(handle_) & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) != 0;
}
std::size_t device::profiling_timer_resolution() const {
  return ask<CL_DEVICE_PROFILING_TIMER_RESOLUTION>(handle_);
}

std::uint32_t device::nvidia_compute_capability() const {
  if (!has_extension("cl_nv_device_attribute_query")) return 0;
  const auto asked = [&](cl_device_info what) {
    cl_uint value = 0;
    const cl_int result = clGetDeviceInfo(handle_, what, sizeof value, &value, nullptr);
    return result == CL_SUCCESS ? value : 0;
  };
  // CL_DEVICE_COMPUTE_CAPABILITY_MAJOR_NV and _MINOR_NV (cl_nv_device_attribute_query).
  return asked(0x4000) * 10 + asked(0x4001);
}

}  // namespace facet::runtime
