// facet sweep: which work-group is fastest, in three experiments.
#include "study/sweep.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <random>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/picture_size.hpp"
#include "cli/progress.hpp"
#include "cli/sweep_plan.hpp"
#include "cli/sweep_table.hpp"
#include "image/output.hpp"
#include "scene/nearest.hpp"
#include "study/sweep_json.hpp"

namespace facet::cli {
namespace {

struct arguments {
  CLI::App* app = nullptr;
  sweep_request request;
  std::vector<std::string> experiments;
  std::string json, shapes = "all", device;
  std::uint32_t max_depth = 0, seed = 0;
  unsigned repeats = 10, serial_repeats = 10;
  size tile;
  tracer::options tracer;
  console say;
};

[[noreturn]] void interrupted_at(const arguments& o, int percent, bool saved) {
  throw interrupted_error(
      "interrupted at " + std::to_string(percent) + "%; " +
      (saved ? "what was measured is in " + o.json + ", marked as not complete"
             : "nothing was measured yet, and " + o.json + " is as it was before"));
}

study::sweep_settings settings_of(const arguments& o, const runtime::device& d) {
  study::sweep_settings s;
  s.shapes = study::parse_shapes(o.shapes, d.max_work_group_size());
  s.repeats = o.repeats;
  s.serial_repeats = o.serial_repeats;
  s.seed = o.app->count("--seed") ? o.seed : std::random_device()();
  s.tracer = o.tracer;
  s.tracer.tile_width = o.tile.width, s.tracer.tile_height = o.tile.height;
  return s;
}

int run(const arguments& o) {
  if (o.device == "serial" || o.device == "serial-double")
    throw usage_error("--device " + o.device +
                      " has no work-groups to sweep; choose an OpenCL device (`facet devices`). "
                      "The serial reference is timed beside it");
  if (image::same_file(o.json, o.request.scene))
    throw usage_error("--json would overwrite the scene, " + o.request.scene);
  image::check_output(o.json);
  const runtime::device device = choose_device(o.device, o.say);
  const study::sweep_settings settings = settings_of(o, device);
  sweep_request request = o.request;
  if (o.app->count("--experiments")) request.only = o.experiments;
  if (o.app->count("--max-depth")) request.max_depth = o.max_depth;
  const std::unique_ptr<sweep_plan> p = plan_sweep(request, device.is_gpu(), o.say);

  study::sweep_result result;
  int percent = 0;
  const auto save = [&] {
    result.left_out = p->left_out;
    image::write_file(o.json, study::to_json(result));
  };
  try {
    progress_bar bar("sweeping", o.say.quiet);
    study::run_sweep(
        runtime::queue(device), p->experiments, settings, result,
        [&](std::uint64_t now, std::uint64_t all) {
          bar.update(now, all);
          percent = int(100 * now / std::max<std::uint64_t>(1, all));
        },
        &interrupt_flag());
  } catch (...) {
    if (result.has_samples()) {
      save();
      o.say.say("what was measured is in " + o.json + ", marked as not complete");
    }
    throw;
  }
  if (result.has_samples()) save();
  for (const study::experiment_result& e : result.experiments)
    if (!e.order.empty()) print_table(e);
  if (!result.complete) interrupted_at(o, percent, result.has_samples());
  o.say.say("wrote " + o.json);
  const std::vector<std::string> wrong = result.differences();
  if (wrong.empty()) return cli::done;
  std::string message = "pictures depend on the work-group, which the device or the kernel breaks:";
  for (const std::string& line : wrong) message += "\n" + line;
  throw device_error(message);
}

CLI::Validator list_of_shapes() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        try {
          study::parse_shapes(text, 1);
          return "";
        } catch (const study::shape_error& e) {
          return e.what();
        }
      },
      "", "list_of_shapes");
}

CLI::Validator known_experiment() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        const std::vector<std::string>& known = sweep_experiments();
        if (std::find(known.begin(), known.end(), text) != known.end()) return "";
        return unknown_name("experiment", text, known);
      },
      "", "known_experiment");
}

}  // namespace

command add_sweep(CLI::App& program) {
  auto o = std::make_shared<arguments>();
  CLI::App* app =
      program.add_subcommand("sweep", "Which work-group is fastest, and how sure it is");
  o->app = app;
  app->add_option("SCENE", o->request.scene,
                  "A scene: .json; a mesh alone: .obj, .ply; or a generator, like torus_knot.\n"
                  "Small enough to be traced without a tree: some thousand triangles")
      ->required();
  app->add_option("--json", o->json,
                  "Where the results go: every sample, as bench/facet-sweep.schema.json has it")
      ->type_name("FILE")
      ->required();
  add_device(*app, o->device, false);
  app->add_option("--shapes", o->shapes,
                  "Work-groups: all (each width and height that is a power of two, up to the\n"
                  "device's limit, and the driver's choice; the default), or a list like\n"
                  "8x8,16x4,driver. The first is what the others' pictures are held against")
      ->type_name("LIST")
      ->check(list_of_shapes());
  app->add_option("--experiments", o->experiments,
                  "Which of: no-tree (SCENE, every triangle tested for every ray), tree (SCENE),\n"
                  "large (the larger scene). Default: all three")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(known_experiment());
  app->add_option("--large", o->request.large,
                  "The larger scene, named like SCENE (default: hills of 500,000 triangles)")
      ->type_name("SCENE");
  add_picture_size(*app, o->request.picture.width, o->request.picture.height);
  app->add_option("--brute-width", o->request.brute_width,
                  "Pixels; width of the picture without a tree, in the same aspect ratio")
      ->type_name("N")
      ->check(whole_number(1, limits::image_side, "pixels"));
  app->add_option("--max-depth", o->max_depth,
                  "Bounces; 0 traces eye rays and shadows alone (default: the scene's)")
      ->type_name("N")
      ->check(whole_number(0, limits::max_depth, "bounces"));
  app->add_option("--repeats", o->repeats, "Timed pictures of each shape (default 10)")
      ->type_name("N")
      ->check(whole_number(1, 100000, "times"));
  app->add_option("--serial-repeats", o->serial_repeats,
                  "Timed pictures of the serial reference (default 10); 0 leaves it out, and with\n"
                  "it all speed-ups")
      ->type_name("N")
      ->check(whole_number(0, 100000, "times"));
  app->add_option("--seed", o->seed,
                  "Of the random order and of the intervals (default: another each time; it is\n"
                  "recorded)")
      ->type_name("N")
      ->check(whole_number(0, 0xffffffffu, ""));
  add_size(*app, "--tile-size", o->tile, limits::image_side,
           "Pixels of a launch (default: the whole picture). A device with a watchdog may need it");
  add_kernels(*app, o->tracer);
  add_console(*app, o->say);
  app->footer(
      "Default sizes: 1280 pixels wide on a GPU and 256 elsewhere, divided by the side of the\n"
      "scene's grid of samples; without a tree halved until eye rays times triangles are at most\n"
      "250 million, and 10 million elsewhere. With scenes/knot.json all shapes of all experiments\n"
      "then take 2 to 4 minutes on PoCL with two cores.\n"
      "Times on stdout are medians with their 95% intervals; the best are all whose intervals\n"
      "overlap. Exit code 4 if a shape's picture is not the first one's, bit for bit.\n"
      "Interrupted, it writes what it has, marked as not complete.\n"
      "What is left open follows from the kind of device, not from what `facet tune` has "
      "measured.");
  return {app, [o] { return run(*o); }};
}

}  // namespace facet::cli
