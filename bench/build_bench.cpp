// Row `build`: how fast the device builds trees, beside Embree on the CPU's threads, all taking
// turns in one run.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "bench/embree_peer.hpp"
#include "bench/kept_build.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "image/output.hpp"
#include "runtime/runtime.hpp"
#include "study/statistics.hpp"
#include "study/tree_makers.hpp"
#include "study/tree_quality.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"};
  std::vector<std::string> trees{"levels", "binned"};
  std::string device = "0", layout = "auto", face = "auto", flags, json;
  unsigned repeat = 10, threads = std::thread::hardware_concurrency();
  bool no_peers = false, quality = false, kept = false, steps = false;
};

/// Words of the builders that run on the device.
std::vector<std::string> device_builders() {
  std::vector<std::string> words;
  for (const study::tree_maker& m : study::tree_makers())
    if (m.kind) words.push_back(m.word);
  return words;
}

/// Whose builds are timed: one of the device's builders, or Embree at one quality.
struct contestant {
  std::string name;
  std::optional<tracer::options> ours;
  embree_quality quality = embree_quality::medium;
  double warm_up_s = 0;
  std::vector<double> seconds{};  ///< of the builds after the warm-up
  double compile_ms = 0;          ///< of the warm-up: what a program's first build waits for
  std::vector<double> upload_ms{};
  tracer::statistics last{};
  json facts = nullptr;  ///< of its tree, if they were asked for
};

std::vector<contestant> contestants_of(const settings& o, bool with_peer) {
  std::vector<contestant> all;
  for (const std::string& word : o.trees) {
    tracer::options options;
    options.tree = *study::tree_maker_of(word)->kind;
    options.layout = o.layout == "wide"     ? tracer::layout_kind::wide
                     : o.layout == "narrow" ? tracer::layout_kind::narrow
                                            : tracer::layout_kind::automatic;
    all.push_back({word, options});
  }
  if (with_peer) {
    all.push_back({"embree-low", {}, embree_quality::low});
    all.push_back({"embree-medium", {}, embree_quality::medium});
  }
  return all;
}

json quality_of(const tracer::device_scene& built, const runtime::queue& queue, const scene& s,
                tracer::tree_kind kind) {
  const study::tree_quality q = study::quality_of(built.read_trees().meshes.at(0));
  const double binary = study::cost_with_best_leaves(
      tracer::built_tree(queue, kind, tracer::pack(s, false).corners), 4);
  return {{"sah_cost", q.sah_cost},
          {"binary_sah_cost", binary},
          {"depth", q.depth},
          {"bytes_a_triangle", q.bytes_a_primitive}};
}

/// The first build is not among the samples.
void build_once(contestant& c, const runtime::queue& queue, const scene& s, embree_builder* peer,
                unsigned repeat, bool with_quality) {
  double taken;
  if (c.ours) {
    const tracer::device_scene built(queue, s, *c.ours);
    c.last = built.prepared();
    taken = 1e-3 * c.last.build_ms;
    if (repeat > 0) c.upload_ms.push_back(c.last.upload_ms);
    if (repeat == 0) c.compile_ms = c.last.compile_ms;
    if (repeat == 0 && with_quality) c.facts = quality_of(built, queue, s, c.ours->tree);
  } else {
    taken = peer->build(c.quality);
  }
  if (repeat == 0)
    c.warm_up_s = taken;
  else
    c.seconds.push_back(taken);
}

json rates(const std::vector<double>& seconds, double triangles) {
  std::vector<double> rate;
  for (const double s : seconds) rate.push_back(triangles / s * 1e-6);
  const study::summary r = study::summarize(rate);
  return {{"mtriangles_per_s", r.median},
          {"mtriangles_per_s_least", r.least},
          {"mtriangles_per_s_most", r.most},
          {"seconds", seconds}};
}

/// How much longer each of the peer's builds took than ours of the same turn.
json ratio_of(const contestant& peer, const contestant& ours) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.seconds.size(); ++i)
    ratios.push_back(peer.seconds[i] / ours.seconds[i]);
  const study::summary r = study::summarize(ratios);
  return {{"median", r.median}, {"least", r.least}, {"most", r.most}};
}

json row_of(const contestant& c, const std::string& mesh, std::uint64_t triangles) {
  json row{{"mesh", mesh}, {"triangles", triangles}, {"builder", c.name}};
  if (c.ours) {
    row["layout"] = c.last.layout;
    row["compile_ms"] = c.compile_ms;
    row["upload_ms"] = c.upload_ms;
    row["depth"] = c.last.tree_depth;
    row["bytes"] = c.last.device_bytes;
    row["peak_bytes"] = c.last.peak_bytes;
  }
  row["warm_up_s"] = c.warm_up_s;
  row["build"] = rates(c.seconds, double(triangles));
  if (!c.facts.is_null()) row["quality"] = c.facts;
  return row;
}

void print(const json& row) {
  const json& b = row["build"];
  std::printf("%-20s %10llu  %-14s %9.3f  %9.3g (%.3g-%.3g)",
              row["mesh"].get<std::string>().c_str(),
              static_cast<unsigned long long>(row["triangles"].get<std::uint64_t>()),
              row["builder"].get<std::string>().c_str(),
              1e3 * study::summarize(b["seconds"].get<std::vector<double>>()).median,
              b["mtriangles_per_s"].get<double>(), b["mtriangles_per_s_least"].get<double>(),
              b["mtriangles_per_s_most"].get<double>());
  if (row.contains("ratios"))
    for (const auto& [peer, r] : row["ratios"].items())
      std::printf("  %.2f (%.2f-%.2f) of %s", r["median"].get<double>(), r["least"].get<double>(),
                  r["most"].get<double>(), peer.c_str());
  if (row.contains("compile_ms"))
    std::printf("  compiled in %.0f ms", row["compile_ms"].get<double>());
  if (row.contains("quality"))
    std::printf("  SAH cost %.2f, binary %.2f", row["quality"]["sah_cost"].get<double>(),
                row["quality"]["binary_sah_cost"].get<double>());
  std::printf("\n");
  std::fflush(stdout);
}

/// All contestants' rows of one mesh.
std::vector<json> measure(const settings& o, const std::string& path, const runtime::queue& queue,
                          bool with_peer) {
  const std::string mesh = name_of(path);
  const scene s = scene_of(load_workload(path));
  std::optional<embree_builder> peer;
  if (with_peer) peer.emplace(s.meshes[0], o.threads);
  std::vector<contestant> all = contestants_of(o, with_peer);
  for (unsigned i = 0; i <= o.repeat; ++i)
    for (contestant& c : all) build_once(c, queue, s, peer ? &*peer : nullptr, i, o.quality);
  std::vector<json> rows;
  for (const contestant& c : all) {
    json row = row_of(c, mesh, s.triangle_count());
    for (const contestant& p : all)
      if (c.ours && !p.ours) row["ratios"][p.name] = ratio_of(p, c);
    rows.push_back(std::move(row));
  }
  return rows;
}

/// Builds into memory that is kept: the median by the host's clock, and each kernel's time in the
/// last build by the device's.
json kept_row(const settings& o, const std::string& path, const scene& s,
              const std::string& builder, const runtime::queue& queue) {
  tracer::tuning t = tracer::tuning_for(queue.get_device());
  t.more_flags = o.flags;
  if (o.face == "group") {
    t.build_in_groups();
    // A CPU interprets them, for Oclgrind at worst: no more of them than find races.
    if (!queue.get_device().is_gpu()) t.list_group = t.scan_group = 32, t.list_each = 8;
  }
  if (o.face == "serial") t.build_alone();
  kept_build k(queue, s, t, *study::tree_maker_of(builder)->kind);
  k.build();
  std::vector<double> seconds;
  for (unsigned i = 0; i < o.repeat; ++i) seconds.push_back(k.build());
  const auto triangles = double(s.triangle_count());
  json row{{"mesh", name_of(path)},
           {"triangles", s.triangle_count()},
           {"builder", builder},
           {"build", rates(seconds, triangles)},
           {"bytes_a_triangle", double(k.bytes()) / triangles},
           {"kernel_ms", k.kernel_ms()}};
  const study::summary r = study::summarize(seconds);
  double sum = 0;
  for (const auto& [name, ms] : k.kernel_ms()) sum += ms;
  std::printf("%-20s %10.0f  %-14s %9.3f (%.3f-%.3f)  kernels %.3f ms, %.1f bytes a triangle\n",
              row["mesh"].get<std::string>().c_str(), triangles, (builder + ", kept").c_str(),
              1e3 * r.median, 1e3 * r.least, 1e3 * r.most, sum, double(k.bytes()) / triangles);
  if (o.steps)
    for (const auto& [name, ms] : k.kernel_ms())
      std::printf("    %-16s %8.4f ms\n", name.c_str(), ms);
  return row;
}

void run(const settings& o) {
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = runtime::select_device(o.device);
  const runtime::queue queue(device);
  const std::string peer = o.no_peers ? "" : embree_version();
  json report = head_of("facet-bench-build", study::origin_now(device));
  report["settings"] = {
      {"repeats", o.repeat}, {"warm_ups", 1}, {"builders", o.trees}, {"layout", o.layout}};
  report["peer"] = peer_of(peer, o.threads);
  report["results"] = json::array();
  report["refused"] = json::array();
  std::printf("on %s; ms: median; Mtriangles/s: median (least-most)%s\n", device.name().c_str(),
              !peer.empty() ? "; times as fast as Embree, turn by turn"
              : o.no_peers  ? ""
                            : "; built without Embree: its figures are left out");
  for (const std::string& path : o.meshes) {
    try {
      if (o.kept) {
        const scene s = scene_of(load_workload(path));
        for (const std::string& builder : o.trees)
          report["results"].push_back(kept_row(o, path, s, builder, queue));
        continue;
      }
      for (json& row : measure(o, path, queue, !peer.empty())) {
        print(row);
        report["results"].push_back(std::move(row));
      }
    } catch (const runtime::exception& e) {
      if (e.code() != runtime::errc::memory_allocation) throw;
      report["refused"].push_back({{"mesh", path}, {"reason", e.what()}});
      std::printf("%-20s refused: %s\n", path.c_str(), e.what());
    }
    if (!o.json.empty()) write_result(o.json, report);
  }
  if (o.kept && !o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_build_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row = app.add_subcommand(
      "build", "Building trees: the device's builders against Embree's of low and medium quality");
  row->add_option("--mesh", o->meshes, "OBJ files, terrain:N (2 N^2 triangles) or soup:N")
      ->capture_default_str();
  row->add_option("--tree", o->trees, "builders")
      ->delimiter(',')
      ->check(CLI::IsMember(device_builders()))
      ->capture_default_str();
  row->add_option("--layout", o->layout, "of nodes and triangles")
      ->check(CLI::IsMember({"auto", "narrow", "wide"}))
      ->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--repeat", o->repeat, "timed builds of each, after one to warm up, in turns")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--threads", o->threads, "threads that Embree builds with")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  row->add_flag("--no-peers", o->no_peers, "leave Embree out");
  row->add_flag("--quality", o->quality, "the trees' SAH costs, too (facet info --tree has more)");
  row->add_flag("--kept", o->kept, "builds into memory that is kept, from corners on the device");
  row->add_option("--face", o->face, "with --kept: who builds a tree, a group or a work-item alone")
      ->check(CLI::IsMember({"auto", "group", "serial"}))
      ->capture_default_str();
  row->add_option("--flags", o->flags, "with --kept: for the kernels' compiler");
  row->add_flag("--steps", o->steps, "with --kept: each kernel's time");
  row->add_option("--json", o->json, "write the figures to this file, after each mesh");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
