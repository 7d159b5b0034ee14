#include "runtime/error.hpp"

#include <algorithm>
#include <iterator>

#include "runtime/opencl.hpp"

namespace facet::runtime {
namespace {

struct named_code {
  int code;
  const char* name;
  errc meaning;
};

// CL_X as {its value, "CL_X", what it means}.
#define CODE(code, meaning) \
  { code, #code, errc::meaning }
constexpr named_code codes[] = {
    CODE(CL_SUCCESS, success),
    CODE(CL_DEVICE_NOT_FOUND, runtime),
    CODE(CL_DEVICE_NOT_AVAILABLE, runtime),
    CODE(CL_COMPILER_NOT_AVAILABLE, feature_not_supported),
    CODE(CL_MEM_OBJECT_ALLOCATION_FAILURE, memory_allocation),
    CODE(CL_OUT_OF_RESOURCES, runtime),
    CODE(CL_OUT_OF_HOST_MEMORY, memory_allocation),
    CODE(CL_PROFILING_INFO_NOT_AVAILABLE, profiling),
    CODE(CL_MEM_COPY_OVERLAP, invalid),
    CODE(CL_IMAGE_FORMAT_MISMATCH, invalid),
    CODE(CL_IMAGE_FORMAT_NOT_SUPPORTED, feature_not_supported),
    CODE(CL_BUILD_PROGRAM_FAILURE, build),
    CODE(CL_MAP_FAILURE, runtime),
    CODE(CL_MISALIGNED_SUB_BUFFER_OFFSET, invalid),
    CODE(CL_EXEC_STATUS_ERROR_FOR_EVENTS_IN_WAIT_LIST, event),
    CODE(CL_COMPILE_PROGRAM_FAILURE, build),
    CODE(CL_LINKER_NOT_AVAILABLE, feature_not_supported),
    CODE(CL_LINK_PROGRAM_FAILURE, build),
    CODE(CL_DEVICE_PARTITION_FAILED, runtime),
    CODE(CL_KERNEL_ARG_INFO_NOT_AVAILABLE, feature_not_supported),
    CODE(CL_INVALID_VALUE, invalid),
    CODE(CL_INVALID_DEVICE_TYPE, invalid),
    CODE(CL_INVALID_PLATFORM, platform),
    CODE(CL_INVALID_DEVICE, invalid),
    CODE(CL_INVALID_CONTEXT, invalid),
    CODE(CL_INVALID_QUEUE_PROPERTIES, feature_not_supported),
    CODE(CL_INVALID_COMMAND_QUEUE, invalid),
    CODE(CL_INVALID_HOST_PTR, invalid),
    CODE(CL_INVALID_MEM_OBJECT, invalid),
    CODE(CL_INVALID_IMAGE_FORMAT_DESCRIPTOR, invalid),
    CODE(CL_INVALID_IMAGE_SIZE, invalid),
    CODE(CL_INVALID_SAMPLER, invalid),
    CODE(CL_INVALID_BINARY, invalid),
    CODE(CL_INVALID_BUILD_OPTIONS, build),
    CODE(CL_INVALID_PROGRAM, invalid),
    CODE(CL_INVALID_PROGRAM_EXECUTABLE, invalid),
    CODE(CL_INVALID_KERNEL_NAME, kernel),
    CODE(CL_INVALID_KERNEL_DEFINITION, kernel),
    CODE(CL_INVALID_KERNEL, kernel),
    CODE(CL_INVALID_ARG_INDEX, kernel_argument),
    CODE(CL_INVALID_ARG_VALUE, kernel_argument),
    CODE(CL_INVALID_ARG_SIZE, kernel_argument),
    CODE(CL_INVALID_KERNEL_ARGS, kernel_argument),
    CODE(CL_INVALID_WORK_DIMENSION, nd_range),
    CODE(CL_INVALID_WORK_GROUP_SIZE, nd_range),
    CODE(CL_INVALID_WORK_ITEM_SIZE, nd_range),
    CODE(CL_INVALID_GLOBAL_OFFSET, nd_range),
    CODE(CL_INVALID_EVENT_WAIT_LIST, event),
    CODE(CL_INVALID_EVENT, event),
    CODE(CL_INVALID_OPERATION, invalid),
    CODE(CL_INVALID_GL_OBJECT, invalid),
    CODE(CL_INVALID_BUFFER_SIZE, memory_allocation),
    CODE(CL_INVALID_MIP_LEVEL, invalid),
    CODE(CL_INVALID_GLOBAL_WORK_SIZE, nd_range),
    CODE(CL_INVALID_PROPERTY, invalid),
    CODE(CL_INVALID_IMAGE_DESCRIPTOR, invalid),
    CODE(CL_INVALID_COMPILER_OPTIONS, build),
    CODE(CL_INVALID_LINKER_OPTIONS, build),
    CODE(CL_INVALID_DEVICE_PARTITION_COUNT, invalid),
    // Of extensions, which headers of OpenCL 1.2 do not hold.
    {-1001, "CL_PLATFORM_NOT_FOUND_KHR", errc::platform},
    {-9999, "NVIDIA: illegal read or write by a kernel", errc::runtime},
};
#undef CODE

const named_code* find(int code) noexcept {
  const auto* found = std::find_if(std::begin(codes), std::end(codes),
                                   [&](const named_code& c) { return c.code == code; });
  return found == std::end(codes) ? nullptr : found;
}

}  // namespace

const char* code_name(int cl) noexcept {
  const named_code* c = find(cl);
  return c ? c->name : "unknown OpenCL code";
}

errc errc_of(int cl) noexcept {
  const named_code* c = find(cl);
  return c ? c->meaning : errc::runtime;
}

exception failed_call(const char* call, int cl, std::string_view where) {
  std::string message = std::string(call) + ": " + code_name(cl) + " (" + std::to_string(cl) + ")";
  if (!where.empty()) message.append(", ").append(where);
  return {errc_of(cl), message, cl};
}

}  // namespace facet::runtime
