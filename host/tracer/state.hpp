// What a device_scene holds between calls.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "tracer/kernels.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tree.hpp"

namespace facet::tracer {

class sample_renderer;
class scene_mover;

struct device_scene::state {
  runtime::queue queue;
  options chosen;
  tuning tuned;
  features used;
  bool in_images = false;
  bool in_packets = false;  ///< a work-item takes FACET_PACKET rays or pixels
  bool refills = false;     ///< refill_kind::automatic may choose to
  bool streams = false;     ///< stream_kind::automatic may choose to
  runtime::source_tree kernels;
  scene model;  ///< camera, lights and limits of later pictures; with its meshes if they may move
  std::optional<std::vector<std::uint32_t>> camera_media;  ///< innermost first; none: not yet known
  device_geometry geometry;
  std::uint64_t peak_bytes = 0;  ///< of device memory while the geometry was made
  runtime::buffer<Light> lights;
  runtime::buffer<Faults> faults;
  std::optional<runtime::program> trace_program = std::nullopt, refilled_program = std::nullopt,
                                  streamed_program = std::nullopt, render_program = std::nullopt,
                                  probe_program = std::nullopt;
  std::uint32_t render_stack = 0;  ///< entries of pending rays that render_program was built for
  std::shared_ptr<sample_renderer> apart = nullptr;  ///< of the last picture by samples apart
  std::shared_ptr<scene_mover> mover = nullptr;      ///< from the first move on

  /// Compiles on first use, and again where a deeper picture needs a larger stack of pending rays.
  runtime::program compiled_to_trace(const char* file);
  runtime::kernel trace_kernel(bool any);
  runtime::kernel refilled_kernel(const char* name);
  runtime::kernel streamed_kernel(bool any);
  runtime::program compiled_to_render(const char* file, std::uint32_t max_depth) const;
  runtime::kernel render_kernel(std::uint32_t max_depth);
  const char* render_file() const;
  /// Whether the next picture is made by a work-item for each sample; its kernels, for so many
  /// pixels at once.
  bool has_samples_apart() const;
  sample_renderer& sample_kernels(std::uint32_t max_depth, std::uint64_t pixels);
  runtime::kernel probe_kernel(const char* name);
  /// The kernels of traversal are compiled anew: what they are compiled for has changed.
  void forget_programs();

  /// Around the camera.
  const std::vector<std::uint32_t>& media();

  /// Sets a kernel's first arguments, those of every traversal (cl/trace.cl, cl/render.cl).
  std::uint32_t set_geometry(runtime::handler& h);
  std::uint32_t set_normals(runtime::handler& h, std::uint32_t k);
  /// Those of every kernel that shades, too: normals, lights and the view.
  std::uint32_t set_picture(runtime::handler& h, runtime::buffer<View>& view);

  void clear_faults();
  /// Waits for what was submitted.
  Faults read_faults();
  /// What is known before anything runs: device, tree, features, times of preparation.
  void describe(statistics& s) const;
};

}  // namespace facet::tracer
