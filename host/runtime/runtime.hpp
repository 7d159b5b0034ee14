// A SYCL-2020-style host runtime over OpenCL: kernels are OpenCL C text, the rest reads as SYCL.
//
//   queue q{select_device("")};
//   program p(q.get_context(), sources, "scale.cl", "-DFACTOR=2");
//   kernel scale = p.get_kernel("scale");
//   std::vector<float> data(1000, 1.f);
//   {
//     buffer b(data);
//     q.submit([&](handler& h) {
//       accessor x{b, h, read_write};
//       h.set_args(x);
//       h.parallel_for(range(data.size()), scale);
//     });
//   }  // the last owner of b waits, and writes back to data
//
// What of the SYCL 2020 specification (revision 9, by section) is here:
//
//  4.6.1  device selectors    default_, cpu_, gpu_selector_v, select_device; aspect_selector is
//  not:
//                             score by the getters of device.
//  4.6.2  platform            get_platforms, get_devices, name, vendor, version.
//  4.6.3  context             of one device or several; context::of(device) is the one that queues
//                             share. No async_handler of its own: each queue has one.
//  4.6.4  device              one named getter a fact instead of get_info<>; no sub-devices.
//  4.6.5  queue               submit, wait, wait_and_throw, throw_asynchronous; in order unless
//                             asked otherwise. No shortcuts (queue::parallel_for), no secondary
//                             queue: they hide what a command group depends on.
//  4.6.6  event               wait, wait_and_throw, get_wait_list, status, profiling.
//  4.7.2  buffer              one dimension (kernels index by themselves); copy-in, write-back,
//                             set_final_data by pointer. No sub-buffers, no allocators, no
//                             reinterpret: a kernel's pointer type is its own. One context each.
//  4.7.3  images              image2d of RGBA floats, as SYCL's unsampled image; samplers are
//                             written in the kernel. Other formats and dimensions: no user yet.
//  4.7.6  accessors           accessor, host_accessor, local_accessor, image_accessor; read_only,
//                             write_only, read_write, no_init. Whole buffers: an offset is a kernel
//                             argument. No placeholders, no host_task.
//  4.8    USM                 left out: OpenCL 1.2 has no shared pointers, NVIDIA's OpenCL neither.
//  4.9.1  ranges              range, id, nd_range with offset, in OpenCL's order (dimension 0 is
//                             get_global_id(0)). item, nd_item, group: OpenCL C's own functions.
//  4.9.4  handler             set_arg(s), depends_on, parallel_for, single_task, copy, fill. No
//                             lambdas as kernels, reductions, streams: single-source features.
//  4.11   kernel bundles      program (an executable bundle) and kernel; specialisation constants
//                             are -D options. Includes are resolved here (expand), texts embedded
//                             at build time (facet_embed in runtime/embed.cmake).
//  4.13   errors              exception with errc and OpenCL's code; async_handler. With no handler
//                             wait_and_throw throws the first failure, where SYCL terminates.
//  4.15   atomics, 4.16 streams, 4.17 functions, 5 device code: OpenCL C has its own.
//  4.5.1  common reference    all classes are handles with value semantics; members may be called
//                             from several threads at once. Destructors never throw.
//
// Dependencies follow from accessors: a reader waits for the last writer, a writer also for the
// readers since, over all queues of one context. They become OpenCL wait lists as a group is
// submitted; there is no thread behind them, and nothing waits for more than it needs.
#pragma once

#include "runtime/access.hpp"
#include "runtime/accessor.hpp"
#include "runtime/argument.hpp"
#include "runtime/buffer.hpp"
#include "runtime/context.hpp"
#include "runtime/device.hpp"
#include "runtime/error.hpp"
#include "runtime/event.hpp"
#include "runtime/handler.hpp"
#include "runtime/host_accessor.hpp"
#include "runtime/image.hpp"
#include "runtime/platform.hpp"
#include "runtime/program.hpp"
#include "runtime/queue.hpp"
#include "runtime/range.hpp"
#include "runtime/source_tree.hpp"
