// Row `move`: what it costs that a scene moves: vertices and instances, against a scene that is
// made anew, and how fast a tree is traced whose triangles have moved apart.
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "image/output.hpp"
#include "runtime/runtime.hpp"
#include "scene/generate.hpp"
#include "study/statistics.hpp"
#include "study/tree_makers.hpp"
#include "study/tree_quality.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"};
  std::vector<double> amplitudes{0, 0.01, 0.03, 0.1, 0.3};
  std::vector<std::uint32_t> instances{10, 1000, 100'000};
  std::string device = "0", layout = "auto", tree = "binned", flags, json;
  unsigned repeat = 10;
  bool no_rays = false;
};

tracer::options options_of(const settings& o) {
  tracer::options t;
  t.movable = true;
  t.compiler_flags = o.flags;
  t.tree = *study::tree_maker_of(o.tree)->kind;
  t.layout = o.layout == "wide"     ? tracer::layout_kind::wide
             : o.layout == "narrow" ? tracer::layout_kind::narrow
                                    : tracer::layout_kind::automatic;
  return t;
}

/// Milliseconds of repeated work, and what of them went where, by the tracer's own account.
struct times {
  std::vector<double> ms{}, upload_ms{}, build_ms{};

  void add(double seconds, const tracer::statistics& s) {
    ms.push_back(1e3 * seconds);
    upload_ms.push_back(s.upload_ms);
    build_ms.push_back(s.build_ms);
  }
};

json to_json(const std::vector<double>& samples) {
  const study::summary s = study::summarize(samples);
  return {{"median", s.median}, {"least", s.least}, {"most", s.most}, {"samples", samples}};
}

json to_json(const times& t) {
  return {{"ms", to_json(t.ms)},
          {"upload_ms", to_json(t.upload_ms)},
          {"build_ms", to_json(t.build_ms)}};
}

/// What a scene on a device and one made anew took for the same, in turns. The first turn is not
/// among the samples: programs are compiled in it, and memory is taken.
struct both {
  times moved{}, anew{};

  void turn(bool counts, tracer::device_scene& scene, const std::function<void()>& move,
            std::unique_ptr<tracer::device_scene>& made,
            const std::function<std::unique_ptr<tracer::device_scene>()>& make) {
    const double in_move = seconds(move);
    made.reset();
    const double in_making = seconds([&] { made = make(); });
    if (!counts) return;
    moved.add(in_move, scene.prepared());
    anew.add(in_making, made->prepared());
  }
  double ratio() const {
    return study::summarize(anew.ms).median / study::summarize(moved.ms).median;
  }
};

/// Waves over the mesh, whose longest side is 1: heights change by up to `amplitude`, and so do the
/// other coordinates, by waves of their own.
std::vector<vec3f> waved(const std::vector<vec3f>& from, double amplitude, double time) {
  std::vector<vec3f> to;
  to.reserve(from.size());
  const auto wave = [&](double along, double across) {
    return float(amplitude * std::sin(23 * along + 11 * across + time));
  };
  for (const vec3f& p : from)
    to.push_back(p + vec3f(wave(p.y, p.z), wave(p.x, p.z), wave(p.x, p.y)));
  return to;
}

/// Rates of the moved tree and of the one made anew, turn by turn; moves the hits out.
json rates_of(const char* kind, const std::vector<ray>& rays, tracer::device_scene& moved,
              tracer::device_scene& anew, unsigned repeat, std::vector<hit>* met) {
  const std::vector<tracer::ray> input = packed(rays);
  std::array<std::vector<double>, 2> rates;
  std::vector<double> ratios;
  for (unsigned i = 0; i < repeat; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      tracer::statistics s;
      const auto hits = (k == 0 ? moved : anew).trace(input, false, 2, &s);
      rates[k].push_back(1e-3 * double(rays.size()) / s.kernel_ms.back());
      if (met && met->empty())
        for (const tracer::hit& h : hits) met->push_back({h.t, h.u, h.v, h.instance, h.triangle});
    }
    ratios.push_back(rates[0].back() / rates[1].back());
  }
  json j{{"rays", rays.size()}, {"ratio", to_json(ratios)}};
  j["moved_mrays_per_s"] = to_json(rates[0]);
  j["anew_mrays_per_s"] = to_json(rates[1]);
  std::printf("  %s %.3g of %.3g", kind, study::summarize(rates[0]).median,
              study::summarize(rates[1]).median);
  return j;
}

double median_of(const std::vector<double>& v) { return study::summarize(v).median; }

/// One mesh, its waves growing: the same scene on the device moves from each to the next.
void measure_waves(const settings& o, const std::string& path, const runtime::queue& queue,
                   const std::function<void(json)>& give) {
  scene s = scene_of(load_workload(path));
  mesh& m = s.meshes[0];
  const std::vector<vec3f> still = m.positions;
  tracer::device_scene moved(queue, s, options_of(o));
  const std::vector<ray> primary = primary_rays();
  for (const double amplitude : o.amplitudes) {
    both t;
    std::unique_ptr<tracer::device_scene> anew;
    for (unsigned i = 0; i <= o.repeat; ++i) {
      m.positions = waved(still, amplitude, 0.1 * i);
      t.turn(
          i > 0, moved, [&] { moved.move_vertices(0, m.positions); }, anew,
          [&] { return std::make_unique<tracer::device_scene>(queue, s, options_of(o)); });
    }
    const auto cost_of = [](const tracer::device_scene& d) {
      return study::quality_of(d.read_trees().meshes.at(0)).sah_cost;
    };
    json row{{"mesh", name_of(path)},
             {"triangles", m.triangle_count()},
             {"layout", moved.prepared().layout},
             {"amplitude", amplitude},
             {"move", to_json(t.moved)},
             {"anew", to_json(t.anew)},
             {"times_as_fast", t.ratio()},
             {"sah_cost", {{"moved", cost_of(moved)}, {"anew", cost_of(*anew)}}}};
    std::printf(
        "%-16s %8.3g  %8.2f (upload %.2f, device %.2f)  %8.2f (build %.2f)  SAH %6.2f of %6.2f",
        name_of(path).c_str(), amplitude, median_of(t.moved.ms), median_of(t.moved.upload_ms),
        median_of(t.moved.build_ms), median_of(t.anew.ms), median_of(t.anew.build_ms),
        row["sah_cost"]["moved"].get<double>(), row["sah_cost"]["anew"].get<double>());
    if (!o.no_rays) {
      std::vector<hit> met;
      row["primary"] = rates_of("eye", primary, moved, *anew, o.repeat, &met);
      row["bounce"] =
          rates_of("bounce", bounce_rays(m, primary, met), moved, *anew, o.repeat, nullptr);
    }
    std::printf("\n");
    std::fflush(stdout);
    give(std::move(row));
  }
}

/// `n` spheres, each somewhere else and turned otherwise at each time.
std::vector<transform> scattered(std::uint32_t n, double time) {
  std::vector<transform> all;
  all.reserve(n);
  const double side = std::cbrt(double(n));
  for (std::uint32_t k = 0; k < n; ++k) {
    const double a = k * 0.754877666 + 0.01 * time, b = k * 0.569840291 - 0.01 * time,
                 c = k * 0.362069135 + 0.02 * time;
    const vec3d at{a - std::floor(a), b - std::floor(b), c - std::floor(c)};
    all.push_back(transform::translate(at * side) * transform::rotate({1, 2, 3}, k + 10 * time) *
                  transform::scale({0.3, 0.2, 0.3}));
  }
  return all;
}

json instances_row(const settings& o, std::uint32_t n, const runtime::queue& queue) {
  scene s = scene_of(generate("icosphere", {{"subdivisions", 1}}));
  s.instances.assign(n, {});
  const auto put = [&](const std::vector<transform>& to) {
    for (std::uint32_t k = 0; k < n; ++k) s.instances[k].world_from_object = to[k];
  };
  put(scattered(n, 0));
  tracer::device_scene moved(queue, s, options_of(o));
  both t;
  std::unique_ptr<tracer::device_scene> anew;
  for (unsigned i = 0; i <= o.repeat; ++i) {
    const std::vector<transform> to = scattered(n, i);
    put(to);
    t.turn(
        i > 0, moved, [&] { moved.place(to); }, anew,
        [&] { return std::make_unique<tracer::device_scene>(queue, s, options_of(o)); });
  }
  std::printf("%-16u           %8.2f  %35.2f (build %.2f)\n", n, median_of(t.moved.ms),
              median_of(t.anew.ms), median_of(t.anew.build_ms));
  std::fflush(stdout);
  return {{"instances", n},
          {"triangles", s.meshes[0].triangle_count()},
          {"layout", moved.prepared().layout},
          {"move", to_json(t.moved)},
          {"anew", to_json(t.anew)},
          {"times_as_fast", t.ratio()}};
}

void run(const settings& o) {
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = runtime::select_device(o.device);
  const runtime::queue queue(device);
  json report = head_of("facet-bench-move", study::origin_now(device));
  report["settings"] = {
      {"repeats", o.repeat}, {"warm_ups", 1}, {"tree", o.tree}, {"layout", o.layout}};
  report["results"] = json::array();
  report["instances"] = json::array();
  const auto keep = [&](const char* where, json row) {
    report[where].push_back(std::move(row));
    if (!o.json.empty()) write_result(o.json, report);
  };
  std::printf(
      "on %s; ms, medians by the host's clock: moved; made anew; then cost and Mrays/s of the tree "
      "that has moved, of the one made anew\n",
      device.name().c_str());
  for (const std::string& path : o.meshes)
    measure_waves(o, path, queue, [&](json row) { keep("results", std::move(row)); });
  for (const std::uint32_t n : o.instances) keep("instances", instances_row(o, n, queue));
}

}  // namespace

void add_move_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row = app.add_subcommand("move",
                                     "Moving vertices and instances against making the scene anew, "
                                     "and what a moved tree is worth");
  row->add_option("--mesh", o->meshes, "OBJ files, terrain:N (2 N^2 triangles) or soup:N")
      ->capture_default_str();
  row->add_option("--amplitude", o->amplitudes,
                  "of waves that the vertices follow, in shares of the longest side, in this order")
      ->check(CLI::Range(0.0, 1000.0))
      ->capture_default_str();
  row->add_option("--instances", o->instances, "how many spheres move, each number a measurement")
      ->check(CLI::Range(1, 1 << 24))
      ->capture_default_str();
  row->add_option("--tree", o->tree, "builder")
      ->check(CLI::IsMember({"levels", "binned"}))
      ->capture_default_str();
  row->add_option("--layout", o->layout, "of nodes and triangles")
      ->check(CLI::IsMember({"auto", "narrow", "wide"}))
      ->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--repeat", o->repeat, "timed turns of each, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_flag("--no-rays", o->no_rays, "trace none: SAH costs alone say what a tree is worth");
  row->add_option("--flags", o->flags, "for the kernels' compiler");
  row->add_option("--json", o->json, "write the figures to this file, after each row");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
