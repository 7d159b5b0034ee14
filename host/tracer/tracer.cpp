#include "tracer/tracer.hpp"

#include <utility>

#include "scene/media.hpp"
#include "tracer/pack.hpp"
#include "tracer/sample_render.hpp"
#include "tracer/state.hpp"
#include "tracer/wide_geometry.hpp"

namespace facet::tracer {
namespace {

/// A scene's camera, surroundings and lights: what later pictures need of it.
scene without_meshes(const scene& s) {
  scene shell;
  shell.name = s.name;
  shell.view = s.view;
  shell.samples = s.samples;
  shell.ambient = s.ambient;
  shell.background = s.background;
  shell.background_alpha = s.background_alpha;
  shell.nesting = s.nesting;
  shell.materials = s.materials;
  shell.lights = s.lights;
  return shell;
}

void apply(const kernel_edit& e, runtime::source_tree& kernels) {
  const auto file = kernels.files.find(e.file);
  if (file == kernels.files.end())
    throw runtime::exception(runtime::errc::invalid,
                             "a kernel variant edits " + e.file + ", which is not there");
  std::string& text = file->second;
  const std::size_t at = text.find(e.from);
  if (at == std::string::npos || text.find(e.from, at + 1) != std::string::npos)
    throw runtime::exception(runtime::errc::invalid, "a kernel variant edits \"" + e.from +
                                                         "\", which " + e.file +
                                                         " does not hold exactly once");
  text.replace(at, e.from.size(), e.to);
}

tuning tuning_with(const options& o, const runtime::device& d) {
  tuning t = tuning_for(d);
  t.more_flags = o.compiler_flags;
  t.starts_soon = o.starts_soon;
  if (!o.defaults) return t;
  if (const std::string fault = fault_of(*o.defaults, d); !fault.empty())
    throw runtime::exception(runtime::errc::invalid,
                             "defaults for " + d.name() + " that it cannot have: " + fault);
  static_cast<choices&>(t) = *o.defaults;
  return t;
}

bool is_in_images(const options& o, const tuning& t) {
  return o.geometry == geometry_kind::image ||
         (o.geometry == geometry_kind::automatic && t.image_geometry &&
          o.layout != layout_kind::wide && o.packets != packet_kind::on);
}

bool is_wide(const options& o, bool in_images, const tuning& t) {
  if (o.layout == layout_kind::wide && in_images)
    throw runtime::exception(runtime::errc::invalid,
                             "geometry in images was asked for in the wide layout, which is for "
                             "buffers; use --geometry buffer, or the narrow layout");
  return o.layout == layout_kind::wide || (o.layout == layout_kind::automatic && !in_images &&
                                           (t.wide_layout || o.packets == packet_kind::on));
}

bool is_in_packets(const options& o, bool is_wide, const tuning& t) {
  const bool can_be = is_wide && o.tree != tree_kind::none;
  if (o.packets == packet_kind::on && !can_be)
    throw runtime::exception(runtime::errc::invalid,
                             "packets of rays were asked for, which take the wide layout and a "
                             "tree; use --packets auto, "
                             "or off");
  return can_be &&
         (o.packets == packet_kind::on || (o.packets == packet_kind::automatic && t.packets));
}

/// Whether refill_kind::automatic may mean on.
bool may_refill(const options& o, bool is_wide, const tuning& t) {
  const bool can = !is_wide && o.tree != tree_kind::none, in_warps = !t.warps || t.group % 32 == 0;
  if (o.refill == refill_kind::on && !(can && in_warps))
    throw runtime::exception(
        runtime::errc::invalid,
        "warps that take new rays were asked for, which need the narrow layout, a tree and "
        "work-groups of a multiple of 32; found " +
            std::string(is_wide ? "the wide layout"
                        : !can  ? "no tree"
                                : "groups of ") +
            (can ? std::to_string(t.group) : ""));
  return can && in_warps && t.warps;
}

/// Whether stream_kind::automatic may mean on.
bool may_stream(const options& o, bool in_packets, const features& used, const runtime::device& d) {
  const bool can = in_packets && !used.instances && !d.is_gpu();
  if (o.streams == stream_kind::on && !can)
    throw runtime::exception(runtime::errc::invalid,
                             "streams of rays were asked for, which take a CPU, packets, and a "
                             "scene of one mesh that is placed by the "
                             "identity; found " +
                                 std::string(!in_packets      ? "no packets"
                                             : used.instances ? "instances"
                                                              : "a GPU"));
  return can && o.streams != stream_kind::off;
}

runtime::buffer<Light> light_buffer(const std::vector<Light>& lights) {
  return lights.empty() ? runtime::buffer<Light>(1)
                        : runtime::buffer<Light>(lights.data(), lights.size());
}

}  // namespace

const char* word_of(tree_kind kind) {
  switch (kind) {
    case tree_kind::none:
      return "none";
    case tree_kind::levels:
      return "levels";
    case tree_kind::binned:
      return "binned";
  }
  return "";
}

device_scene::device_scene(runtime::queue queue, const scene& s, options o,
                           std::span<const given_tree> given) {
  const tuning tuned = tuning_with(o, queue.get_device());
  const features used = o.all_features ? features::all() : features::of(s);
  const bool in_images = is_in_images(o, tuned);
  const bool wide = is_wide(o, in_images, tuned);
  const bool in_packets = is_in_packets(o, wide, tuned), refills = may_refill(o, wide, tuned),
             streams = may_stream(o, in_packets, used, queue.get_device());
  runtime::source_tree kernels =
      o.kernel_folder.empty() ? kernel_sources() : runtime::read_folder(o.kernel_folder);
  for (const kernel_edit& e : o.edits) apply(e, kernels);
  packed_scene packed = pack(s, used.smooth);
  runtime::buffer<Light> lights = light_buffer(packed.lights);
  runtime::context context = queue.get_context();
  context.restart_peak();
  const std::uint64_t before = context.memory_in_use();
  device_geometry geometry = wide ? build_wide_geometry(queue, kernels, std::move(packed), used,
                                                        o.tree, tuned, given, o.movable)
                                  : build_geometry(queue, kernels, std::move(packed), used, o.tree,
                                                   in_images, tuned, given);

  const std::uint64_t peak = context.peak_memory() - before;
  scene model = o.movable ? s : without_meshes(s);
  state_ = std::make_unique<state>(state{queue, std::move(o), tuned, used, in_images, in_packets,
                                         refills, streams, std::move(kernels), std::move(model),
                                         media_around_camera(s), std::move(geometry), peak,
                                         std::move(lights), runtime::buffer<Faults>(1)});
}

device_scene::~device_scene() = default;
device_scene::device_scene(device_scene&&) noexcept = default;
device_scene& device_scene::operator=(device_scene&&) noexcept = default;

void device_scene::set_work_group(std::uint32_t width, std::uint32_t height) {
  state_->chosen.group_width = width;
  state_->chosen.group_height = height;
  state_->chosen.driver_group = false;
}

void device_scene::leave_work_group_to_driver() { state_->chosen.driver_group = true; }

runtime::program device_scene::state::compiled_to_trace(const char* file) {
  return compiled(queue, kernels, file,
                  traversal_options(used, model.nesting, chosen.tree, in_images, geometry.is_wide,
                                    geometry.stack, 0, tuned) +
                      register_cap(tuned.trace_registers));
}

runtime::kernel device_scene::state::trace_kernel(bool any) {
  if (!trace_program)
    trace_program = compiled_to_trace(in_packets ? "trace_packets.cl" : "trace.cl");
  return trace_program->get_kernel(any ? "trace_any" : "trace_closest");
}

runtime::kernel device_scene::state::refilled_kernel(const char* name) {
  if (!refilled_program) refilled_program = compiled_to_trace("trace_refilled.cl");
  return refilled_program->get_kernel(name);
}

runtime::kernel device_scene::state::streamed_kernel(bool any) {
  if (!streamed_program) streamed_program = compiled_to_trace("trace_streams.cl");
  return streamed_program->get_kernel(any ? "trace_any" : "trace_closest");
}

runtime::kernel device_scene::state::probe_kernel(const char* name) {
  constexpr std::uint32_t one_bounce = 1;
  if (!probe_program)
    probe_program =
        compiled(queue, kernels, "probe.cl",
                 traversal_options(used, model.nesting, chosen.tree, in_images, geometry.is_wide,
                                   geometry.stack, one_bounce, tuned));
  return probe_program->get_kernel(name);
}

void device_scene::state::forget_programs() {
  trace_program.reset();
  refilled_program.reset();
  streamed_program.reset();
  render_program.reset();
  probe_program.reset();
  apart.reset();
}

const std::vector<std::uint32_t>& device_scene::state::media() {
  if (!camera_media) camera_media = media_around_camera(model);
  return *camera_media;
}

std::uint32_t device_scene::state::set_geometry(runtime::handler& h) {
  std::uint32_t k = 0;
  h.set_arg(k++, runtime::accessor{geometry.world, h, runtime::read_only});
  if (geometry.is_wide)
    h.set_arg(k++, runtime::accessor{geometry.wide_nodes, h, runtime::read_only});
  else
    h.set_arg(k++, runtime::accessor{geometry.nodes, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{geometry.instances, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{geometry.infos, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{geometry.materials, h, runtime::read_only});
  h.set_arg(k++, runtime::accessor{faults, h, runtime::read_write});
  if (in_images)
    h.set_arg(k++, runtime::image_accessor{*geometry.corner_image, h, runtime::read_only});
  else
    h.set_arg(k++, runtime::accessor{geometry.corners, h, runtime::read_only});
  return k;
}

std::uint32_t device_scene::state::set_normals(runtime::handler& h, std::uint32_t k) {
  if (in_images)
    h.set_arg(k++, runtime::image_accessor{*geometry.normal_image, h, runtime::read_only});
  else
    h.set_arg(k++, runtime::accessor{geometry.normals, h, runtime::read_only});
  return k;
}

void device_scene::state::clear_faults() {
  queue.submit([&](runtime::handler& h) {
    const runtime::accessor all{faults, h, runtime::write_only};
    h.fill(all, Faults{});
  });
}

Faults device_scene::state::read_faults() {
  const runtime::host_accessor found{faults, runtime::read_only};
  return found[0];
}

statistics device_scene::prepared() const {
  statistics s;
  state_->describe(s);
  return s;
}

void device_scene::state::describe(statistics& s) const {
  const runtime::device d = queue.get_device();
  s.device = d.name();
  s.platform = d.platform_name();
  s.driver = d.driver_version();
  program_set programs = geometry.programs;
  for (const auto* p : {&trace_program, &refilled_program, &streamed_program, &render_program})
    if (*p) programs.add(**p);
  if (apart) apart->add_programs(programs);
  s.compile_ms = programs.build_ms();
  s.upload_ms = geometry.upload_ms;
  s.build_ms = geometry.build_ms;
  s.geometry = in_images ? "image" : "buffer";
  s.layout = geometry.is_wide ? "wide" : "narrow";
  s.rays_a_work_item = in_packets ? FACET_PACKET : 1;
  s.is_tuned = chosen.defaults.has_value();
  s.features = used.names();
  s.tree_depth = geometry.depth;
  s.tree_nodes = geometry.nodes_used;
  s.device_bytes = geometry.bytes;
  s.peak_bytes = peak_bytes;
}

}  // namespace facet::tracer
