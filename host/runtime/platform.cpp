#include "runtime/platform.hpp"

#include "runtime/device.hpp"
#include "runtime/opencl.hpp"

namespace facet::runtime {
namespace {

constexpr cl_int platform_not_found_khr = -1001;  // the ICD loader's word for "none"

template <cl_platform_info Info>
std::string ask(native::platform p) {
  return detail::call([&] { return cl::Platform(p).getInfo<Info>(); });
}

}  // namespace

std::vector<platform> platform::get_platforms() {
  cl_uint count = 0;
  const cl_int found = clGetPlatformIDs(0, nullptr, &count);
  if (found == platform_not_found_khr || (found == CL_SUCCESS && count == 0)) return {};
  if (found != CL_SUCCESS) throw failed_call("clGetPlatformIDs", found);
  std::vector<cl_platform_id> ids(count);
  const cl_int listed = clGetPlatformIDs(count, ids.data(), nullptr);
  if (listed != CL_SUCCESS) throw failed_call("clGetPlatformIDs", listed);
  return {ids.begin(), ids.end()};
}

std::vector<device> platform::get_devices() const {
  cl_uint count = 0;
  const cl_int found = clGetDeviceIDs(handle_, CL_DEVICE_TYPE_ALL, 0, nullptr, &count);
  if (found == CL_DEVICE_NOT_FOUND || (found == CL_SUCCESS && count == 0)) return {};
  if (found != CL_SUCCESS) throw failed_call("clGetDeviceIDs", found);
  std::vector<cl_device_id> ids(count);
  const cl_int listed = clGetDeviceIDs(handle_, CL_DEVICE_TYPE_ALL, count, ids.data(), nullptr);
  if (listed != CL_SUCCESS) throw failed_call("clGetDeviceIDs", listed);
  return {ids.begin(), ids.end()};
}

std::string platform::name() const { return ask<CL_PLATFORM_NAME>(handle_); }
std::string platform::vendor() const { return ask<CL_PLATFORM_VENDOR>(handle_); }
std::string platform::version() const { return ask<CL_PLATFORM_VERSION>(handle_); }

}  // namespace facet::runtime
