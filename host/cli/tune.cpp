// facet tune: what is fastest on a device, measured once and kept for later runs.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/mesh_word.hpp"
#include "cli/options.hpp"
#include "cli/picture_size.hpp"
#include "cli/progress.hpp"
#include "cli/tune_table.hpp"
#include "cli/tuning_file.hpp"
#include "image/output.hpp"
#include "scene/nearest.hpp"
#include "scene/placed.hpp"
#include "study/tunables.hpp"
#include "study/tuning_json.hpp"
#include "study/tuning_run.hpp"
#include "tracer/tuning.hpp"

namespace facet::cli {
namespace {

namespace fs = std::filesystem;

struct arguments {
  CLI::App* app = nullptr;
  std::string device, out, kernels;
  std::vector<std::string> scenes, only;
  bool is_quick = false, show = false, forget = false;
  std::uint32_t width = 0;
  unsigned rounds = 0;  ///< 0: by default
  console say;
};

/// Eye rays in a line: a GPU has work for all its threads, and a CPU is done in some milliseconds.
constexpr std::uint32_t gpu_width = 1280, other_width = 512, quick_width = 128;
constexpr unsigned usual_rounds = 10, quick_rounds = 4;

fs::path table_path(const arguments& o) {
  const fs::path path = o.out.empty() ? tuning_path() : fs::path(o.out);
  if (path.empty())
    throw usage_error(
        "there is no place for a table: FACET_TUNING is set and empty, or there is no home; name a "
        "file by --out");
  return path;
}

/// The folders of `path`, made if need be; whether the file can be made is tried.
void prepare_table(const fs::path& path) {
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (error)
    throw image::output_error(path, "the folder \"" + path.parent_path().string() +
                                        "\" cannot be made: " + error.message());
  image::check_output(path);
}

std::vector<study::tuning_scene> scenes_of(const arguments& o, std::uint32_t width) {
  if (o.scenes.empty()) return study::tuning_scenes(width, o.is_quick);
  std::vector<study::tuning_scene> all;
  for (const std::string& word : o.scenes) {
    study::tuning_scene& s = all.emplace_back();
    s.what = placed(picture_of_word(word));
    s.what.name = word;
    o.say.notes(s.what.notes);
    const size picture = picture_size({width, 0}, {s.what.width, s.what.height});
    s.width = picture.width, s.height = picture.height;
  }
  return all;
}

study::tuning_settings settings_of(const arguments& o, bool on_gpu) {
  study::tuning_settings s;
  s.is_quick = o.is_quick;
  s.only = o.only;
  s.rounds = o.rounds ? o.rounds : o.is_quick ? quick_rounds : usual_rounds;
  s.repeats = on_gpu ? 3 : 1;
  s.tracer.kernel_folder = o.kernels;
  return s;
}

/// The old table with the new entry; a table that cannot be read is replaced.
void save(const fs::path& path, const study::tuning_result& result) {
  std::string text;
  try {
    text = study::table_with(path, result);
  } catch (const study::tuning_error&) {
    text = study::table_of(result);
  }
  image::write_file(path, text);
}

int tune(const arguments& o) {
  if (o.device == "serial" || o.device == "serial-double")
    throw usage_error("--device " + o.device +
                      " leaves nothing to choose; name an OpenCL device (`facet devices`)");
  const fs::path path = table_path(o);
  if (!o.kernels.empty() && o.out.empty())
    throw usage_error(
        "--kernels measures other kernels than later runs have; name a file of their own by --out");
  const runtime::device device = choose_device(o.device, o.say);
  prepare_table(path);
  try {
    study::read_tuning_table(path);
  } catch (const study::tuning_error& e) {
    o.say.say("note: the table is replaced by a new one, since it cannot be read: " +
              std::string(e.what()));
  }
  const std::uint32_t width = o.width           ? o.width
                              : device.is_gpu() ? gpu_width
                              : o.is_quick      ? quick_width
                                                : other_width;
  const std::vector<study::tuning_scene> scenes = scenes_of(o, width);
  std::uint64_t pixels = 0;
  for (const study::tuning_scene& s : scenes) pixels += std::uint64_t(s.width) * s.height;
  // Rays of three kinds, their hits and a picture, and once more those of a run.
  require_memory(pixels * (3 * (sizeof(tracer::ray) + 2 * sizeof(tracer::hit)) + 2 * 16),
                 "rays and pictures " + std::to_string(width) + " pixels wide");
  stop_if_interrupted("making the scenes");

  study::tuning_result result;
  std::optional<progress_bar> bar;
  std::string doing = "preparing";
  study::tuning_watch watch;
  watch.on_run = [&](const std::string& name, std::uint64_t done, std::uint64_t most) {
    doing = "tuning " + name;
    if (!bar) bar.emplace(doing, o.say.quiet);
    bar->update(done, most);
  };
  watch.on_choice = [&](const study::choice_result& c) {
    bar.reset();
    if (!o.say.quiet) print_choice(c);
  };
  try {
    study::run_tuning(runtime::queue(device), scenes, settings_of(o, device.is_gpu()), result,
                      watch, &interrupt_flag());
  } catch (const study::tuning_difference& e) {
    throw device_error("a value changes what is traced, which the device or the kernel breaks: " +
                       std::string(e.what()) + "; nothing was saved");
  }
  bar.reset();
  if (!result.complete)
    throw interrupted_error("interrupted while " + doing + "; nothing was saved, and " +
                            path.string() + " is as it was before");
  save(path, result);
  o.say.say("wrote " + path.string() + ": " +
            (result.values == result.usual
                 ? "nothing is faster than the built-in defaults by more than the spread"
                 : "later runs take these values") +
            " on " + device.name());
  return done;
}

/// All devices, or the one that was named.
std::vector<runtime::device> devices_of(const arguments& o) {
  if (o.app->count("--device")) return {choose_device(o.device, o.say)};
  std::vector<runtime::device> all = runtime::device::get_devices();
  if (all.empty()) no_device();
  return all;
}

int show(const arguments& o) {
  const fs::path path = o.out.empty() ? tuning_path() : fs::path(o.out);
  const study::tuning_table table =
      path.empty() ? study::tuning_table() : study::read_tuning_table(path);
  for (const runtime::device& d : devices_of(o)) {
    const tracer::choices usual = tracer::tuning_for(d);
    const auto values = table.values_for(d);
    std::printf("%s, %s, driver %s\n", d.name().c_str(), d.platform_name().c_str(),
                d.driver_version().c_str());
    if (values)
      std::printf("   tuned %s, %s\n", table.find(d)->date.c_str(), table.file.c_str());
    else if (const study::tuned_entry* other = table.find_other_driver(d))
      std::printf("   built-in defaults: %s has it under driver %s alone\n", table.file.c_str(),
                  other->of.driver.c_str());
    else
      std::printf("   built-in defaults%s\n",
                  path.empty() ? "" : (": not in " + path.string()).c_str());
    print_values(values.value_or(usual), usual);
  }
  return done;
}

int forget(const arguments& o) {
  const fs::path path = table_path(o);
  const runtime::device device = choose_device(o.device, o.say);
  const study::tuned_device of = study::tuned_device_of(study::facts_of(device));
  const study::tuning_table table = study::read_tuning_table(path);
  if (std::none_of(table.entries.begin(), table.entries.end(),
                   [&](const study::tuned_entry& e) { return e.of.is_same_but_for_driver(of); })) {
    o.say.say(path.string() + " has nothing for " + device.name());
    return done;
  }
  image::write_file(path, study::table_without(path, of));
  o.say.say("wrote " + path.string() + ", without " + device.name());
  return done;
}

CLI::Validator known_tunable() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        std::vector<std::string> known;
        for (const study::tunable& t : study::tunables()) known.push_back(t.name);
        if (std::find(known.begin(), known.end(), text) != known.end()) return "";
        return unknown_name("choice", text, known);
      },
      "", "known_tunable");
}

std::string footer() {
  std::string text = "Choices, in the order in which they are made:\n";
  for (const study::tunable& t : study::tunables())
    text += "  " + t.name + std::string(14 - t.name.size(), ' ') + t.about + "\n";
  return text +
         "A value is taken if it is faster than the one before by more than 2% and by more than "
         "the\n"
         "spread, in two sets of rounds (README). All must give the same bits: if not, the exit "
         "code\n"
         "is 4. Interrupted, it leaves the table as it was.\n"
         "The table is $FACET_TUNING, or facet/tuning.json in $XDG_CONFIG_HOME or ~/.config;\n"
         "FACET_TUNING= (empty) or --no-tuning do without.";
}

}  // namespace

command add_tune(CLI::App& program) {
  auto o = std::make_shared<arguments>();
  CLI::App* app = program.add_subcommand(
      "tune", "Which layout, work-groups and kernels are fastest on a device, for later runs");
  o->app = app;
  add_device(*app, o->device, false);
  CLI::Option* show_flag =
      app->add_flag("--show", o->show, "Print what holds for each device, and where it comes from");
  CLI::Option* forget_flag =
      app->add_flag("--forget", o->forget, "Take the device out of the table")->excludes(show_flag);
  app->add_flag("--quick", o->is_quick,
                "Small scenes and few rounds: seconds in place of minutes, and less sure")
      ->excludes(show_flag)
      ->excludes(forget_flag);
  app->add_option("--scenes", o->scenes,
                  "Measure on rays and pictures of these, named as for `facet sweep`\n"
                  "(default: a knot, hills of 500,000 triangles, and a still life with glass)")
      ->type_name("SCENE");
  app->add_option("--only", o->only, "Make these choices alone (default: all)")
      ->type_name("CHOICE,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(known_tunable());
  app->add_option("--width", o->width,
                  "Pixels; width of pictures and eye rays (default: 1280 on a GPU and 512\n"
                  "elsewhere, 128 with --quick)")
      ->type_name("N")
      ->check(whole_number(8, 8192, "pixels"));
  app->add_option("--rounds", o->rounds, "Timed runs of each value (default 10; 4 with --quick)")
      ->type_name("N")
      ->check(whole_number(3, 1000, "rounds"));
  app->add_option("--out", o->out, "The table, in place of the usual file")->type_name("FILE");
  app->add_option("--kernels", o->kernels,
                  "Read the OpenCL C files from this folder, not from the program")
      ->type_name("DIR");
  add_console(*app, o->say);
  app->footer(footer());
  return {app, [o] { return o->show ? show(*o) : o->forget ? forget(*o) : tune(*o); }};
}

}  // namespace facet::cli
