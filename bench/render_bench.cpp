// Row `render`: whole pictures on a device, of each width and depth that is asked for, by several
// ways, all in turns; rays counted by kind. A picture is one tile if the device has room for its
// samples.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "runtime/runtime.hpp"
#include "scene/load.hpp"
#include "scene/placed.hpp"
#include "scene/read_obj.hpp"
#include "study/picture_errors.hpp"
#include "study/picture_rays.hpp"
#include "study/statistics.hpp"
#include "study/still_life.hpp"
#include "study/tuning_table.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> scenes, meshes;
  std::vector<std::string> ways{"default", "single", "all-features"};
  std::string device = "0", kernels, flags, tuning, json;
  std::optional<tracer::choices> defaults;  ///< of `tuning`
  std::uint32_t group_width = 0, group_height = 0;
  std::vector<std::uint32_t> widths{0};
  std::vector<int> depths{-1};
  int repeat = 5;
};

/// A way to make a picture, and its times.
struct way {
  std::string name;
  tracer::options options;
  std::unique_ptr<tracer::device_scene> on{};
  tracer::statistics stats{};
  std::vector<double> kernel_ms{}, wall_ms{};
  std::size_t differs = 0;  ///< pixels that are not the first way's
};

way way_of(const std::string& name, const settings& o) {
  way w{name, {}};
  w.options.kernel_folder = o.kernels;
  w.options.compiler_flags = o.flags.empty() ? "" : " " + o.flags;
  w.options.defaults = o.defaults;
  w.options.group_width = o.group_width, w.options.group_height = o.group_height;
  if (name == "single") {
    w.options.packets = tracer::packet_kind::off;
    w.options.samples_apart = false;
  }
  if (name == "all-features") w.options.all_features = true;
  if (name == "narrow") w.options.layout = tracer::layout_kind::narrow;
  if (name == "image") w.options.geometry = tracer::geometry_kind::image;
  return w;
}

struct shape {
  std::uint32_t width, height, depth;
  bool operator==(const shape&) const = default;
};

/// Every width at every depth, each once.
std::vector<shape> shapes_of(const scene& s, const settings& o) {
  std::vector<shape> all;
  for (const int d : o.depths)
    for (const std::uint32_t w : o.widths) {
      const std::uint32_t width = w ? w : s.width;
      const shape p{width, height_for(s, width), d < 0 ? s.max_depth : std::uint32_t(d)};
      if (std::find(all.begin(), all.end(), p) == all.end()) all.push_back(p);
    }
  return all;
}

json spread(const std::vector<double>& ms) {
  const study::summary t = study::summarize(ms);
  return {{"median", t.median}, {"least", t.least}, {"most", t.most}, {"all", ms}};
}

json figures_of(const way& w, const std::string& name, const scene& s, shape p,
                const study::picture_rays& rays) {
  const study::summary kernel = study::summarize(w.kernel_ms), wall = study::summarize(w.wall_ms);
  std::printf("%-22s %5ux%-5u depth %-2u %-13s %9.2f (%.2f-%.2f)  %9.2f  %8.1f  %7.0f  %zu\n",
              name.c_str(), p.width, p.height, p.depth, w.name.c_str(), kernel.median, kernel.least,
              kernel.most, wall.median, double(rays.total()) / kernel.median * 1e-3,
              w.stats.compile_ms, w.differs);
  return {{"scene", name},
          {"way", w.name},
          {"width", p.width},
          {"height", p.height},
          {"samples", s.samples},
          {"max_depth", p.depth},
          {"triangles", s.triangle_count()},
          {"features", w.stats.features},
          {"layout", w.stats.layout},
          {"geometry", w.stats.geometry},
          {"pixels_a_work_item", w.stats.rays_a_work_item},
          {"tiles", w.stats.tiles},
          {"rays", {{"eye", rays.eye}, {"bounced", rays.bounced}, {"shadow", rays.shadow}}},
          {"kernel_ms", spread(w.kernel_ms)},
          {"wall_ms", spread(w.wall_ms)},
          {"mrays_per_s", double(rays.total()) / kernel.median * 1e-3},
          {"build_ms", w.stats.build_ms},
          {"compile_ms", w.stats.compile_ms},
          {"pixels_that_differ", w.differs}};
}

/// A picture's shape, and all ways to make it.
struct entry {
  shape p;
  std::vector<way> ways;
  study::picture_rays rays;
};

picture render(tracer::device_scene& on, shape p, tracer::statistics& stats) {
  return on.render(p.width, p.height, p.depth, &stats);
}

/// One picture by each way, and its rays counted. The entry has device scenes of its own: kernels
/// depend on the depth they were last compiled for, and memory for samples on the largest picture.
entry prepared(const scene& s, shape p, runtime::queue& queue, const settings& o) {
  entry e{p, {}, {}};
  picture first;
  for (const std::string& each : o.ways) {
    way w = way_of(each, o);
    w.options.tile_width = p.width, w.options.tile_height = p.height;
    w.on = std::make_unique<tracer::device_scene>(queue, s, w.options);
    const picture found = render(*w.on, p, w.stats);
    if (e.ways.empty()) first = found;
    w.differs = study::differing_pixels(first, found);
    e.ways.push_back(std::move(w));
  }
  tracer::device_scene counting(queue, s, study::counting_rays(e.ways[0].options));
  tracer::statistics counted;
  render(counting, p, counted);
  e.rays = study::rays_of(counted, e.ways[0].stats);
  return e;
}

/// Appends the figures of every shape and way, which all take turns, since a machine's speed moves;
/// true if all pictures of a shape are the same.
bool measure(const scene& s, const std::string& name, runtime::queue& queue, const settings& o,
             json& results) {
  std::vector<entry> entries;
  for (const shape& p : shapes_of(s, o)) entries.push_back(prepared(s, p, queue, o));
  for (int k = 0; k < o.repeat; ++k)
    for (entry& e : entries)
      for (way& w : e.ways) {
        render(*w.on, e.p, w.stats);
        w.kernel_ms.push_back(w.stats.kernel_ms.at(0));
        w.wall_ms.push_back(w.stats.wall_ms);
      }
  bool are_same = true;
  for (const entry& e : entries) {
    for (const way& w : e.ways) {
      results.push_back(figures_of(w, name, s, e.p, e.rays));
      are_same = are_same && w.differs == 0;
    }
    std::printf("%-22s rays: %llu eye, %llu bounced, %llu shadow\n", name.c_str(),
                static_cast<unsigned long long>(e.rays.eye),
                static_cast<unsigned long long>(e.rays.bounced),
                static_cast<unsigned long long>(e.rays.shadow));
  }
  std::fflush(stdout);
  return are_same;
}

void run(settings o) {
  if (o.scenes.empty() && o.meshes.empty())
    throw CLI::ValidationError("render",
                               "nothing to render; name scene files, or OBJ files with --mesh");
  const runtime::device device = runtime::select_device(o.device);
  runtime::queue queue(device);
  if (!o.tuning.empty()) o.defaults = study::tuned_values(o.tuning, device);
  json report = head_of("facet-bench-render", study::origin_now(device));
  report["settings"] = {{"repeats", o.repeat},
                        {"flags", o.flags},
                        {"work_group", {o.group_width, o.group_height}},
                        {"tuned", o.defaults.has_value()}};
  report["results"] = json::array();
  std::printf(
      "way; milliseconds: kernel, median (least-most); wall, median; Mrays/s of all kinds; "
      "compiled "
      "in milliseconds; pixels that are not the first way's\n");
  bool are_same = true;
  for (const std::string& path : o.scenes)
    are_same &= measure(placed(load_scene(path)), name_of(path), queue, o, report["results"]);
  for (const std::string& path : o.meshes)
    are_same &= measure(placed(study::still_life(read_obj(path).mesh)),
                        "still life: " + name_of(path), queue, o, report["results"]);
  if (!o.json.empty()) write_result(o.json, report);
  if (!are_same) throw std::runtime_error("ways to make one picture differ: see above");
}

}  // namespace

void add_render_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row = app.add_subcommand("render", "Whole pictures: several ways, rays by kind");
  row->add_option("scenes", o->scenes, "scene files")->check(CLI::ExistingFile);
  row->add_option("--mesh", o->meshes,
                  "OBJ files, each between a glass and a mirror sphere on a reflecting floor")
      ->check(CLI::ExistingFile);
  row->add_option("--way", o->ways,
                  "single: a pixel a work-item; all-features: nothing left out of the kernel")
      ->check(CLI::IsMember({"default", "single", "all-features", "narrow", "image"}))
      ->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--kernels", o->kernels, "read cl/ from this folder");
  row->add_option("--tuning", o->tuning,
                  "a table of `facet tune`, in place of the built-in defaults");
  row->add_option("--flags", o->flags, "added to the compiler's options");
  row->add_option("--group-width", o->group_width, "work-items; 0: the device's default");
  row->add_option("--group-height", o->group_height, "work-items; 0: the device's default");
  row->add_option("--width", o->widths,
                  "pixels; 0: the scene's own; several are measured at each depth, all in turns")
      ->capture_default_str();
  row->add_option("--depth", o->depths, "bounces, one or several; -1: the scene's own")
      ->capture_default_str();
  row->add_option("--repeat", o->repeat, "pictures by each way, taking turns")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
