// facet trace: rays in, hits out.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/mesh_word.hpp"
#include "cli/options.hpp"
#include "cli/progress.hpp"
#include "cli/stats_file.hpp"
#include "cli/tuning_file.hpp"
#include "image/npy.hpp"
#include "image/output.hpp"
#include "reference/tracer.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::cli {
namespace {

using tracer::clock;
using tracer::milliseconds_since;

struct arguments {
  CLI::App* app = nullptr;
  std::string mesh, rays, hits, stats;
  bool any = false;
  unsigned repeat = 1;
  tracing_options tracing;
  console say;
};

std::vector<tracer::ray> read_rays(const std::string& path) {
  const std::vector<float> rows = image::read_npy_rows(path, 8);
  static_assert(sizeof(tracer::ray) == 8 * sizeof(float), "a row is a ray");
  std::vector<tracer::ray> rays(rows.size() / 8);
  if (!rays.empty()) std::memcpy(rays.data(), rows.data(), rows.size() * sizeof(float));
  return rays;
}

template <class T>
tracer::hit trace_one(const reference::tracer<T>& t, const tracer::ray& r, bool any, bool brute) {
  const auto vec = [](const float* v) { return vec3<T>(T(v[0]), T(v[1]), T(v[2])); };
  const reference::ray<T> ray{vec(r.origin), T(r.tmin), vec(r.direction), T(r.tmax)};
  if (any) {
    const bool hit = brute ? t.occluded_brute(ray) : t.occluded(ray);
    return hit ? tracer::hit{0, 0, 0, 0, 0} : tracer::hit{r.tmax, 0, 0, tracer::miss, tracer::miss};
  }
  const reference::hit<T> h = brute ? t.closest_brute(ray) : t.closest(ray);
  return {float(h.t), float(h.u), float(h.v), h.instance, h.triangle};
}

template <class T>
std::vector<tracer::hit> trace_serial(const arguments& o, const scene& s,
                                      const std::vector<tracer::ray>& rays,
                                      tracer::statistics& stats) {
  stats.device = std::is_same_v<T, float> ? "serial" : "serial-double";
  stats.platform = "one CPU thread, no OpenCL";
  stats.rays = rays.size();
  const auto built_from = clock::now();
  const reference::tracer<T> tracer(s);
  stats.build_ms = milliseconds_since(built_from);

  constexpr std::size_t between_checks = 4096;  // rays
  const bool brute = o.tracing.tracer.tree == tracer::tree_kind::none;
  const auto start = clock::now();
  std::vector<tracer::hit> hits(rays.size());
  progress_bar bar("tracing", o.say.quiet);
  for (unsigned round = 0; round < o.repeat; ++round) {
    const auto round_start = clock::now();
    for (std::size_t first = 0; first < rays.size(); first += between_checks) {
      stop_if_interrupted("tracing");
      const std::size_t last = std::min(rays.size(), first + between_checks);
      for (std::size_t i = first; i < last; ++i) hits[i] = trace_one(tracer, rays[i], o.any, brute);
      bar.update(round * rays.size() + last, o.repeat * rays.size());
    }
    stats.kernel_ms.push_back(milliseconds_since(round_start));
  }
  stats.wall_ms = milliseconds_since(start);
  return hits;
}

std::vector<tracer::hit> trace_on_device(const arguments& o, const scene& s,
                                         const std::vector<tracer::ray>& rays,
                                         tracer::statistics& stats) {
  const runtime::device device = choose_device(o.tracing.device, o.say);
  tracer::options options = o.tracing.tracer;
  options.defaults = tuned_defaults(device, o.tracing.no_tuning, o.say);
  tracer::device_scene on_device(runtime::queue(device), s, options);
  stop_if_interrupted("preparing the device");
  auto hits = on_device.trace(rays, o.any, o.repeat, &stats);
  stop_if_interrupted("tracing");
  return hits;
}

/// Triangles as the mesh's file numbers them.
void name_as_in_file(std::vector<tracer::hit>& hits, const scene& s) {
  for (tracer::hit& h : hits)
    if (h.triangle != tracer::miss)
      h.triangle = s.meshes[s.instances[h.instance].mesh].source_of(h.triangle);
}

void check_outputs(const arguments& o) {
  using image::same_file;
  if (same_file(o.hits, o.rays)) throw usage_error("--hits would overwrite the rays, " + o.rays);
  if (!o.stats.empty() && (same_file(o.stats, o.hits) || same_file(o.stats, o.rays)))
    throw usage_error("--stats would overwrite " + o.stats + ", which --rays or --hits names");
  image::check_output(o.hits);
  if (!o.stats.empty()) image::check_output(o.stats);
}

void write_hits(const std::string& path, const std::vector<tracer::hit>& hits) {
  static_assert(sizeof(tracer::hit) == 20, "fields without padding");
  image::write_npy(
      path, {{"t", "<f4"}, {"u", "<f4"}, {"v", "<f4"}, {"instance", "<u4"}, {"triangle", "<u4"}},
      hits.size(), std::as_bytes(std::span(hits)));
}

int run(const arguments& o) {
  if (o.tracing.serial())
    refuse_with_serial(*o.app,
                       {"--geometry", "--kernels", "--packets", "--all-features", "--no-tuning"});
  check_outputs(o);
  const scene s = scene_of_word(o.mesh);
  o.say.notes(s.notes);
  const std::vector<tracer::ray> rays = read_rays(o.rays);
  stop_if_interrupted("reading");

  tracer::statistics stats;
  std::vector<tracer::hit> hits = o.tracing.serial_double()
                                      ? trace_serial<double>(o, s, rays, stats)
                                  : o.tracing.serial() ? trace_serial<float>(o, s, rays, stats)
                                                       : trace_on_device(o, s, rays, stats);
  if (!o.any) name_as_in_file(hits, s);
  write_hits(o.hits, hits);

  const auto hit_count = std::count_if(
      hits.begin(), hits.end(), [](const tracer::hit& h) { return h.triangle != tracer::miss; });
  nlohmann::ordered_json content = to_json(stats);
  if (!o.stats.empty()) {
    content["mesh"] = o.mesh;
    content["triangles"] = s.triangle_count();
    content["hits"] = hit_count;
    content["query"] = o.any ? "any" : "closest";
    write_json(o.stats, content);
  }
  char rate[64];
  std::snprintf(rate, sizeof rate, "%.2f Mrays/s", content["mrays_per_s"].get<double>());
  o.say.say("traced " + std::to_string(rays.size()) + " rays, " + std::to_string(hit_count) +
            " hits, " + rate + " on " + stats.device + "; wrote " + o.hits);
  return done;
}

}  // namespace

command add_trace(CLI::App& program) {
  auto o = std::make_shared<arguments>();
  CLI::App* app = program.add_subcommand("trace", "The hits of rays that a file lists");
  o->app = app;
  app->add_option("MESH", o->mesh,
                  "A mesh in its own coordinates: .obj or .ply; a scene: .json; or a generator,\n"
                  "like terrain:1000, soup:1000000, icosphere:5 or torus_knot:p=3,q=5")
      ->required();
  app->add_option("--rays", o->rays,
                  "NumPy array, float32, of shape (N, 8): origin x y z, tmin, direction x y z, "
                  "tmax.\nA direction may have any length but 0; t counts in its units")
      ->type_name("FILE.npy")
      ->required();
  app->add_option(
         "--hits", o->hits,
         "Where the hits go: a NumPy structured array of shape (N,) with the fields t, u,\n"
         "v ('<f4'), instance, triangle ('<u4'; 4294967295 for a miss). A triangle is\n"
         "counted as in its file, polygons cut into fans")
      ->type_name("FILE.npy")
      ->required();
  app->add_flag("--any", o->any,
                "Stop at the first triangle found: instance and triangle are 0 for a hit");
  app->add_option("--repeat", o->repeat,
                  "Trace this many times; kernel_ms is the median (default 1)")
      ->type_name("N")
      ->check(whole_number(1, 100000, "times"));
  add_tracing(*app, o->tracing);
  app->add_option("--stats", o->stats, "Write times and choices to this file, as JSON")
      ->type_name("FILE");
  add_console(*app, o->say);
  return {app, [o] { return run(*o); }};
}

}  // namespace facet::cli
