#include "runtime/launch.hpp"

#include <algorithm>
#include <string>

namespace facet::runtime::detail {
namespace {

using std::string;
using std::to_string;

string sizes_text(const std::size_t* sizes, int dimensions) {
  string text = to_string(sizes[0]);
  for (int i = 1; i < dimensions; ++i) text.append("x").append(to_string(sizes[i]));
  return text;
}

[[noreturn]] void refuse(errc code, const kernel_state& k, const string& why) {
  throw exception(code, "kernel '" + k.name + "': " + why);
}

const char* word_of(const argument& a, bool is_image) {
  switch (a.what) {
    case argument::kind::value:
      return "a value";
    case argument::kind::local:
      return "a local_accessor";
    case argument::kind::memory:
      return is_image ? "an image_accessor" : "an accessor";
    case argument::kind::unset:
      break;
  }
  return "nothing";
}

bool matches(const parameter& p, const argument& a, bool is_image) {
  switch (p.where) {
    case parameter::space::local:
      return a.what == argument::kind::local;
    case parameter::space::constant:
    case parameter::space::global:
      return a.what == argument::kind::memory && is_image == p.is_image;
    case parameter::space::value:
      return a.what == argument::kind::value || (p.is_image && is_image);
    case parameter::space::unknown:
      break;
  }
  return true;
}

void check_argument(const kernel_state& k, std::size_t i, const argument& a) {
  const parameter& p = k.parameters[i];
  const string name = "argument " + to_string(i) + (p.text.empty() ? "" : " (" + p.text + ")");
  if (a.what == argument::kind::unset)
    refuse(errc::kernel_argument, k,
           name + " was not set; set all " + to_string(k.parameters.size()) + " of them");
  const bool is_image = dynamic_cast<const image_memory*>(a.object) != nullptr;
  if (!matches(p, a, is_image))
    refuse(errc::kernel_argument, k, name + " was given " + word_of(a, is_image));
  if (a.what != argument::kind::memory || p.where == parameter::space::unknown) return;
  // What the runtime does not know of, it cannot order.
  if (p.written_by_kernel && !writes(a.mode))
    refuse(errc::kernel_argument, k,
           name +
               " may be written by the kernel and was given a "
               "read_only accessor; declare it const, or give write "
               "access");
  if (!p.written_by_kernel && !reads(a.mode))
    refuse(errc::kernel_argument, k,
           name + " is only read by the kernel and was given a write_only accessor");
}

void check_arguments(const kernel_state& k, const std::vector<argument>& arguments) {
  if (arguments.size() > k.parameters.size())
    refuse(errc::kernel_argument, k,
           to_string(arguments.size()) +
               " arguments were set, and it "
               "takes " +
               to_string(k.parameters.size()));
  for (std::size_t i = 0; i < k.parameters.size(); ++i)
    check_argument(k, i, i < arguments.size() ? arguments[i] : argument{});
}

void check_local_memory(const kernel_state& k, const kernel_limits& l,
                        const std::vector<argument>& arguments, const device& d) {
  std::uint64_t bytes = l.local_bytes;
  for (const argument& a : arguments)
    if (a.what == argument::kind::local) bytes += a.bytes;
  if (bytes > l.local_bytes && bytes > d.local_mem_size())
    refuse(errc::memory_allocation, k,
           to_string(bytes) + " bytes of local memory a group; " + d.name() + " allows " +
               to_string(d.local_mem_size()));
}

void check_shape(const kernel_state& k, const kernel_limits& l, const launch_shape& s,
                 const device& d) {
  const string local = sizes_text(s.local, s.dimensions);
  std::size_t items = 1;
  const auto& most = l.most_items;
  for (int i = 0; i < s.dimensions; ++i) {
    if (s.local[i] == 0) refuse(errc::nd_range, k, "a work-group of " + local + " is empty");
    if (s.local[i] > most[std::size_t(i)])
      refuse(errc::nd_range, k,
             "a work-group of " + local + " has " + to_string(s.local[i]) +
                 " work-items in dimension " + to_string(i) + "; " + d.name() + " allows " +
                 to_string(most[std::size_t(i)]));
    items *= s.local[i];  // no overflow: each factor is within the device's limits
  }
  // What a kernel requires it was compiled for, whatever the driver then names as the most:
  // NVIDIA's says 256.
  if (!l.required[0] && items > l.work_group_size)
    refuse(errc::nd_range, k,
           "a work-group of " + local + " has " + to_string(items) + " work-items; on " + d.name() +
               " this kernel allows " + to_string(l.work_group_size));
  for (int i = 0; i < s.dimensions; ++i)
    if (s.global[i] % s.local[i] != 0)
      refuse(errc::nd_range, k,
             "the global range " + sizes_text(s.global, s.dimensions) +
                 " is no multiple of the work-group " + local +
                 "; pad it, and guard in the kernel");
  if (l.required[0] && !std::equal(s.local, s.local + 3, l.required.begin()))
    refuse(errc::nd_range, k,
           "a work-group of " + local + ", and the kernel requires " +
               sizes_text(l.required.data(), 3));
}

}  // namespace

void check_launch(const kernel_state& k, launch_shape& shape,
                  const std::vector<argument>& arguments, const device& d) {
  const kernel_limits& l = k.limits_on(d);
  check_arguments(k, arguments);
  check_local_memory(k, l, arguments, d);
  if (!shape.has_local && l.required[0]) {
    shape.has_local = true;
    std::copy(l.required.begin(), l.required.end(), shape.local);
  }
  if (shape.has_local) check_shape(k, l, shape, d);
}

void enqueue_launch(kernel_state& k, const launch_shape& shape,
                    const std::vector<argument>& arguments, const std::vector<std::byte>& values,
                    const cl::CommandQueue& queue, const std::vector<cl::Event>& waits,
                    cl::Event& done) {
  const std::lock_guard lock(k.mutex);
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const argument& a = arguments[i];
    const cl_mem memory = a.object ? a.object->object()() : nullptr;
    const void* value = a.what == argument::kind::local    ? nullptr
                        : a.what == argument::kind::memory ? static_cast<const void*>(&memory)
                                                           : values.data() + a.offset;
    const cl_int result = clSetKernelArg(k.kernel(), cl_uint(i), a.bytes, value);
    if (result != CL_SUCCESS)
      throw failed_call("clSetKernelArg", result,
                        "argument " + to_string(i) + " (" + k.parameters[i].text + ") given " +
                            to_string(a.bytes) + " bytes, " + *k.what);
  }
  const auto range = [&](const std::size_t* s) {
    return shape.dimensions == 1   ? cl::NDRange(s[0])
           : shape.dimensions == 2 ? cl::NDRange(s[0], s[1])
                                   : cl::NDRange(s[0], s[1], s[2]);
  };
  queue.enqueueNDRangeKernel(k.kernel, range(shape.offset), range(shape.global),
                             shape.has_local ? range(shape.local) : cl::NullRange,
                             waits.empty() ? nullptr : &waits, &done);
}

}  // namespace facet::runtime::detail
