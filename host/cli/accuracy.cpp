// facet accuracy: the hard cases, on a device; or speed against error, on a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "cli/accuracy_variants.hpp"
#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/stats_file.hpp"
#include "cli/tuning_file.hpp"
#include "image/output.hpp"
#include "study/cases/cases.hpp"
#include "study/cases/report.hpp"

namespace facet::cli {
namespace {

struct arguments {
  CLI::App* app = nullptr;
  std::string variants;  ///< a scene; "": the cases
  std::vector<std::string> only;
  size picture;
  unsigned repeats = 10;
  std::string cases = "all", device, json;
  double rays = 10000;
  std::uint64_t seed = 1;
  bool with_mistakes = false, no_tuning = false;
  console say;
};

/// "all", or numbers separated by commas.
std::vector<study::hard_case> chosen(const std::string& text) {
  const auto all = study::hard_cases();
  if (text == "all") return {all.begin(), all.end()};
  std::vector<study::hard_case> some;
  std::stringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const study::hard_case& c) {
      return std::to_string(c.number) == word;
    });
    if (found == all.end())
      throw usage_error("--cases: found \"" + word + "\"; allowed: all, or numbers from " +
                        std::to_string(all.front().number) + " to " +
                        std::to_string(all.back().number) + " separated by commas");
    some.push_back(*found);
  }
  if (some.empty())
    throw usage_error("--cases names no case; allowed: all, or numbers like 2,3,26");
  return some;
}

nlohmann::ordered_json content_of(const arguments& o, const runtime::device& d, bool is_tuned,
                                  const std::vector<study::case_report>& reports, bool complete) {
  nlohmann::ordered_json content{{"format", "facet-accuracy"},
                                 {"version", study::report_version},
                                 {"facet", FACET_VERSION},
                                 {"device", d.name()},
                                 {"platform", d.platform_name()},
                                 {"driver", d.driver_version()},
                                 {"rays", std::uint64_t(o.rays)},
                                 {"seed", o.seed},
                                 {"tuned", is_tuned},
                                 {"complete", complete}};
  for (const study::case_report& r : reports) content["cases"].push_back(study::to_json(r));
  return content;
}

void refuse_with(const CLI::App& app, const char* given, std::initializer_list<const char*> names) {
  for (const char* name : names)
    if (app.count(name) > 0)
      throw usage_error(std::string(name) + " has no meaning " + given +
                        "; leave one of the two out");
}

int run_variants(const arguments& o) {
  refuse_with(*o.app, "with --variants", {"--cases", "--rays", "--mistakes", "--no-tuning"});
  if (o.device == "serial" || o.device == "serial-double")
    throw usage_error(
        "--device " + o.device +
        " has no meaning here: the variants are of an OpenCL device, held against the "
        "double reference; `facet devices` lists what there is");
  if (o.seed > 0xffffffffu)
    throw usage_error("--seed: found " + std::to_string(o.seed) + "; with --variants at most " +
                      std::to_string(0xffffffffu) + " is allowed");
  variants_request r{o.variants, o.device, o.json, {}, o.picture, o.repeats, std::uint32_t(o.seed)};
  if (o.app->count("--only")) r.only = o.only;
  return run_accuracy_variants(r, o.say);
}

int run(const arguments& o) {
  if (o.app->count("--variants")) return run_variants(o);
  refuse_with(*o.app, "without --variants SCENE", {"--only", "--size", "--repeats"});
  const std::vector<study::hard_case> cases = chosen(o.cases);
  if (o.device == "serial" || o.device == "serial-double")
    throw usage_error("--device " + o.device +
                      " has no meaning here: the cases hold an OpenCL device against the serial "
                      "tracer and exact arithmetic; `facet devices` lists what there is");
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = choose_device(o.device, o.say);

  study::lab l{runtime::queue(device)};
  l.rays = std::uint64_t(o.rays);
  l.seed = o.seed;
  l.threads = std::max(1u, std::thread::hardware_concurrency());
  l.options.defaults = tuned_defaults(device, o.no_tuning, o.say);
  l.on_batch = [] { stop_if_interrupted("the cases"); };

  std::vector<study::case_report> reports;
  const auto write = [&](bool complete) {
    if (!o.json.empty())
      write_json(o.json, content_of(o, device, l.options.defaults.has_value(), reports, complete));
  };
  std::printf("%s\n", study::table_head(o.with_mistakes).c_str());
  bool all_met = true;
  const std::uint64_t total = cases.size();
  for (std::uint64_t k = 0; k < total; ++k) {
    try {
      progress_bar bar("case " + std::to_string(cases[k].number), o.say.quiet);
      bar.update(k, total);
      reports.push_back(study::run_case(cases[k], l, false));
      if (o.with_mistakes) reports.push_back(study::run_case(cases[k], l, true));
    } catch (const interrupted_error&) {
      write(false);
      throw interrupted_error("interrupted in case " + std::to_string(cases[k].number) +
                              (o.json.empty() ? "" : "; " + o.json + " holds those before it"));
    }
    const study::case_report* caught = o.with_mistakes ? &reports.back() : nullptr;
    const study::case_report& r = caught ? *(&reports.back() - 1) : reports.back();
    std::printf("%s", study::table_row(r, caught, o.say.detailed).c_str());
    std::fflush(stdout);
    all_met = all_met && r.is_met() && (!caught || caught->failures() > 0);
  }
  write(true);
  o.say.say(std::string(all_met ? "every case meets its goal" : "not every case meets its goal") +
            " on " + device.name() + (o.json.empty() ? "" : "; wrote " + o.json));
  return all_met ? done : unmet;
}

}  // namespace

command add_accuracy(CLI::App& program) {
  auto o = std::make_shared<arguments>();
  CLI::App* app =
      program.add_subcommand("accuracy",
                             "Hard numerical cases, held against exact oracles; or, with\n"
                             "--variants, what faster variants cost in error");
  o->app = app;
  app->add_option("--cases", o->cases, "all, or numbers like 2,3,26 (default all)")
      ->type_name("all|N,...");
  app->add_option("--rays", o->rays,
                  "Rays of the cases that count rays (default 1e4); those whose oracle is slow\n"
                  "take fewer. 0 failures of n bound the rate by 3/n (95%)")
      ->type_name("N")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            char* end = nullptr;
            const double n = std::strtod(text.c_str(), &end);
            const bool is_number = !text.empty() && *end == 0;
            if (is_number && n >= 1000 && n <= 1e10 && n == std::floor(n)) return "";
            return "found \"" + text + "\"; whole numbers from 1000 to 1e10 rays are allowed";
          },
          "", "rays"));
  app->add_option("--seed", o->seed, "Of rays and scenes, and of the variants' order (default 1)")
      ->type_name("N");
  add_device(*app, o->device, false);
  app->add_option("--variants", o->variants,
                  "In place of the cases: trace this scene (named as for `facet sweep`) in every\n"
                  "variant there is, and hold each against the double reference")
      ->type_name("SCENE");
  app->add_option("--only", o->only, "Of the variants these alone, and strict: names by commas")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_size(*app, "--size", o->picture, limits::image_side,
           "Pixels of the variants' picture (default: 1280 wide on a GPU and 320 elsewhere,\n"
           "divided by the side of the scene's grid of samples)");
  app->add_option("--repeats,--repeat", o->repeats, "Timed runs of each variant (default 10)")
      ->type_name("N")
      ->check(whole_number(1, 100000, "times"));
  app->add_flag(
      "--mistakes", o->with_mistakes,
      "Run each case also with the mistake in the kernels that it is there to catch, and\n"
      "say how often it did");
  add_no_tuning(*app, o->no_tuning);
  app->add_option("--json", o->json, "Write all findings to this file")->type_name("FILE");
  add_console(*app, o->say);
  return {app, [o] { return run(*o); }};
}

}  // namespace facet::cli
