// facet render: from a scene to a picture.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/options.hpp"
#include "cli/picture_file.hpp"
#include "cli/picture_size.hpp"
#include "cli/progress.hpp"
#include "cli/stats_file.hpp"
#include "cli/tuning_file.hpp"
#include "image/output.hpp"
#include "reference/tracer.hpp"
#include "scene/load.hpp"
#include "scene/placed.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::cli {
namespace {

using tracer::clock;
using tracer::milliseconds_since;

struct arguments {
  CLI::App* app = nullptr;
  std::string scene, out, stats;
  std::uint32_t width = 0, height = 0, max_depth = 0;  ///< 0 x 0: the scene's
  size group, tile;
  image::transfer transfer = image::transfer::srgb;
  tracing_options tracing;
  console say;
};

struct picture_shape {
  std::uint32_t width, height, max_depth;
};

picture_shape shape_of(const arguments& o, const scene& s) {
  const size p = picture_size({o.width, o.height}, {s.width, s.height});
  return {p.width, p.height, o.app->count("--max-depth") ? o.max_depth : s.max_depth};
}

[[noreturn]] void interrupted_at(const arguments& o, std::uint64_t done, std::uint64_t total) {
  const int percent = total ? int(100 * done / total) : 0;
  throw interrupted_error("interrupted at " + std::to_string(percent) +
                          "% of the picture; nothing was saved, and " + o.out +
                          " is as it was before");
}

template <class T>
picture render_serial(const arguments& o, const scene& s, picture_shape p,
                      tracer::statistics& stats) {
  stats.device = std::is_same_v<T, float> ? "serial" : "serial-double";
  stats.platform = "one CPU thread, no OpenCL";
  const auto built_from = clock::now();
  const reference::tracer<T> tracer(s);
  stats.build_ms = milliseconds_since(built_from);
  stop_if_interrupted("building the tree");

  const auto start = clock::now();
  std::uint64_t done = 0;
  progress_bar bar("rendering", o.say.quiet);
  picture result = tracer.render(
      p.width, p.height, p.max_depth,
      [&](std::uint64_t now, std::uint64_t total) {
        bar.update(done = now, total);
        return !interrupt_flag().load();
      },
      &stats.crowded);
  const std::uint64_t total = std::uint64_t(p.width) * p.height;
  if (done < total) interrupted_at(o, done, total);
  stats.wall_ms = milliseconds_since(start);
  stats.kernel_ms = {stats.wall_ms};
  stats.rays = total * s.samples * s.samples;
  stats.tiles = p.height;
  stats.features = "all";
  return result;
}

picture render_on_device(const arguments& o, const scene& s, picture_shape p,
                         tracer::statistics& stats) {
  const runtime::device device = choose_device(o.tracing.device, o.say);
  tracer::options options = o.tracing.tracer;
  options.defaults = tuned_defaults(device, o.tracing.no_tuning, o.say);
  options.group_width = o.group.width, options.group_height = o.group.height;
  options.tile_width = o.tile.width, options.tile_height = o.tile.height;
  options.starts_soon = true;  // one picture is made
  tracer::device_scene on_device(runtime::queue(device), s, options);
  stop_if_interrupted("preparing the device");
  prepare_to_write(o.out);
  progress_bar bar("rendering", o.say.quiet);
  try {
    return on_device.render(
        p.width, p.height, p.max_depth, &stats,
        [&](std::uint64_t done, std::uint64_t total) {
          prepare_at_once();
          bar.update(done, total);
        },
        &interrupt_flag());
  } catch (const tracer::cancelled& c) {
    interrupted_at(o, c.done, c.total);
  }
}

/// What the picture lacks, if anything.
void say_faults(const console& say, const scene& s, const tracer::statistics& stats) {
  if (stats.refused > 0)
    say.say("note: " + std::to_string(stats.refused) +
            " rays were out of range or not finite, and meet nothing");
  if (stats.crowded > 0)
    say.say("note: " + std::to_string(stats.crowded) +
            " times a ray entered a transparent object within " + std::to_string(s.nesting) +
            " others, and forgot the outermost; the scene's \"nesting\" may be up to " +
            std::to_string(limits::nesting));
}

void check_outputs(const arguments& o) {
  check_picture_output(o.out);
  if (o.stats.empty()) return;
  namespace fs = std::filesystem;
  if (fs::absolute(o.stats).lexically_normal() == fs::absolute(o.out).lexically_normal())
    throw usage_error("-o and --stats name the same file, " + o.out);
  image::check_output(o.stats);
}

void write_stats(const arguments& o, picture_shape p, const tracer::statistics& stats) {
  nlohmann::ordered_json content = to_json(stats);
  content["scene"] = o.scene;
  content["width"] = p.width;
  content["height"] = p.height;
  content["max_depth"] = p.max_depth;
  write_json(o.stats, content);
}

int run(const arguments& o) {
  if (o.tracing.serial())
    refuse_with_serial(*o.app, {"--tree", "--packets", "--geometry", "--kernels", "--all-features",
                                "--no-tuning", "--work-group", "--tile-size"});
  check_outputs(o);
  const scene s = placed(load_scene(o.scene));
  o.say.notes(s.notes);
  stop_if_interrupted("reading the scene");
  const picture_shape p = shape_of(o, s);
  require_memory(std::uint64_t(p.width) * p.height * 4 * (sizeof(float) + 1),
                 "a picture of " + std::to_string(p.width) + "x" + std::to_string(p.height));

  tracer::statistics stats;
  const auto start = clock::now();
  const picture result = o.tracing.serial_double() ? render_serial<double>(o, s, p, stats)
                         : o.tracing.serial()      ? render_serial<float>(o, s, p, stats)
                                                   : render_on_device(o, s, p, stats);
  o.say.detail("compiled in " + duration_text(stats.compile_ms) + ", built in " +
               duration_text(stats.build_ms) + ", traced in " +
               duration_text(stats.kernel_ms.at(0)));
  if (!stats.geometry.empty())
    o.say.detail("geometry: " + stats.geometry + "; features: " + stats.features +
                 "; work-group: " + std::to_string(stats.group_width) + "x" +
                 std::to_string(stats.group_height));
  say_faults(o.say, s, stats);
  write_picture_file(o.out, result, o.transfer);
  if (!o.stats.empty()) write_stats(o, p, stats);
  o.say.say("wrote " + o.out + ", " + std::to_string(p.width) + "x" + std::to_string(p.height) +
            ", in " + duration_text(milliseconds_since(start)) + " on " + stats.device);
  return done;
}

}  // namespace

command add_render(CLI::App& program) {
  auto o = std::make_shared<arguments>();
  CLI::App* app = program.add_subcommand("render", "A picture of a scene");
  o->app = app;
  const std::uint32_t side = limits::image_side;
  app->add_option("SCENE", o->scene, "A scene: .json; or a mesh alone: .obj, .ply")->required();
  app->add_option("-o,--output", o->out,
                  "The picture, by its extension: .png (8 bits), .exr or .npy (linear floats)")
      ->type_name("FILE")
      ->required();
  add_picture_size(*app, o->width, o->height);
  app->add_option("--max-depth", o->max_depth,
                  "Bounces; 0 traces eye rays and shadows alone (default: the scene's)")
      ->type_name("N")
      ->check(whole_number(0, limits::max_depth, "bounces"));
  add_transfer(*app, o->transfer,
               "Curve of a .png (default srgb); linear is the plain x255.\n"
               ".exr and .npy are linear and not clamped");
  add_tracing(*app, o->tracing);
  add_size(*app, "--work-group", o->group, side,
           "Work-items of a group (default: as tuned, or by the kind of device)");
  add_size(*app, "--tile-size", o->tile, side,
           "Pixels of a launch (default: as many as take about 50 ms)");
  app->add_option("--stats", o->stats, "Write times and choices to this file, as JSON")
      ->type_name("FILE");
  add_console(*app, o->say);
  return {app, [o] { return run(*o); }};
}

}  // namespace facet::cli
