// OpenCL's handles by name alone, so that no public header needs <CL/cl.h>.
#pragma once

// NOLINTBEGIN(bugprone-reserved-identifier): the names are OpenCL's.
struct _cl_platform_id;
struct _cl_device_id;
struct _cl_context;
struct _cl_command_queue;
struct _cl_mem;
struct _cl_program;
struct _cl_kernel;
struct _cl_event;
// NOLINTEND(bugprone-reserved-identifier)

/// The types of <CL/cl.h>, for callers that mix this runtime with calls of their own. A handle
/// from get() is borrowed: retain it to keep it longer than the object that gave it.
namespace facet::runtime::native {
using platform = ::_cl_platform_id*;  ///< cl_platform_id
using device = ::_cl_device_id*;      ///< cl_device_id
using context = ::_cl_context*;       ///< cl_context
using queue = ::_cl_command_queue*;   ///< cl_command_queue
using memory = ::_cl_mem*;            ///< cl_mem
using program = ::_cl_program*;       ///< cl_program
using kernel = ::_cl_kernel*;         ///< cl_kernel
using event = ::_cl_event*;           ///< cl_event
}  // namespace facet::runtime::native
