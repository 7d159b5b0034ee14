// Row `pictures`: each scene rendered on a device and by the serial reference, in float (how much
// faster, how many pixels are off, and is each of them at an edge) and against double (how wrong).
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "reference/tracer.hpp"
#include "runtime/runtime.hpp"
#include "scene/load.hpp"
#include "scene/placed.hpp"
#include "study/explain.hpp"
#include "study/statistics.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> scenes;
  std::string device = "0", json;
  std::uint32_t width = 0;
  int repeat = 3;
};

json told(const study::explanation& e) {
  float worst = 0;
  for (const study::off_pixel& p : e.off) worst = std::max(worst, p.difference);
  return {{"pixels", e.pixels},
          {"off", e.off.size()},
          {"unexplained", e.unexplained()},
          {"worst", worst}};
}

json measure(const std::string& path, runtime::queue& queue, const settings& o) {
  const scene s = placed(load_scene(path));
  const std::uint32_t width = o.width ? o.width : s.width;
  const std::uint32_t height = height_for(s, width);
  const reference::tracer<float> single(s);
  const reference::tracer<double> oracle(s);
  tracer::device_scene ours(queue, s);

  picture found, expected;
  std::vector<double> device_s, serial_s, ratios;
  tracer::statistics stats;
  for (int i = 0; i < o.repeat; ++i) {
    device_s.push_back(seconds([&] { found = ours.render(width, height, s.max_depth, &stats); }));
    serial_s.push_back(seconds([&] { expected = single.render(width, height, s.max_depth); }));
    ratios.push_back(serial_s.back() / device_s.back());
  }
  const auto against_float = study::explain(s, single, expected, found, s.max_depth);
  const picture exact = oracle.render(width, height, s.max_depth);
  const auto against_double = study::explain(s, oracle, exact, found, s.max_depth);

  const auto device_time = study::summarize(device_s), serial_time = study::summarize(serial_s),
             ratio = study::summarize(ratios);
  const std::string name = name_of(path);
  std::printf("%-22s %5ux%-5u %8.3f %8.3f  %5.2f (%.2f-%.2f)  %6zu %6zu  %6zu %6zu\n", name.c_str(),
              width, height, device_time.median, serial_time.median, ratio.median, ratio.least,
              ratio.most, against_float.off.size(), std::size_t(against_float.unexplained()),
              against_double.off.size(), std::size_t(against_double.unexplained()));
  std::fflush(stdout);
  return {{"scene", name},
          {"width", width},
          {"height", height},
          {"samples", s.samples},
          {"triangles", s.triangle_count()},
          {"features", stats.features},
          {"device_s", device_s},
          {"serial_s", serial_s},
          {"speed_up", {{"median", ratio.median}, {"least", ratio.least}, {"most", ratio.most}}},
          {"against_float", told(against_float)},
          {"against_double", told(against_double)}};
}

void run(const settings& o) {
  const runtime::device device = runtime::select_device(o.device);
  runtime::queue queue(device);
  json report = head_of("facet-bench-pictures", study::origin_now(device));
  report["settings"] = {{"repeats", o.repeat}};
  report["results"] = json::array();
  std::printf(
      "seconds: device, serial float on one thread; speed-up (least-most); pixels off by more "
      "than 1/255, unexplained: against float; against double\n");
  for (const std::string& path : o.scenes) report["results"].push_back(measure(path, queue, o));
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_pictures_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row =
      app.add_subcommand("pictures", "Whole pictures: device against serial float and double");
  row->add_option("scenes", o->scenes, "scene or mesh files")->required()->check(CLI::ExistingFile);
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--width", o->width, "pixels; 0: the scene's own")->capture_default_str();
  row->add_option("--repeat", o->repeat, "runs of device and serial, alternated")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
