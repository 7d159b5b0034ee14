// Row `reference`: closest hits of the float reference against Embree, one thread each, the same
// rays, alternated in one run.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/embree_peer.hpp"
#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "reference/tracer.hpp"
#include "study/statistics.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> models;
  int terrain = 1000, soup = 1000000, repeat = 5;
  std::string json;
};

json figures(const std::vector<double>& times, std::size_t rays) {
  const study::summary s = study::summarize(times);
  const auto rate = [&](double t) { return double(rays) / t * 1e-6; };
  return {{"mrays_per_s", rate(s.median)},
          {"mrays_per_s_least", rate(s.most)},
          {"mrays_per_s_most", rate(s.least)},
          {"seconds", times}};
}

/// Times both on the same rays; prints a line and gives it as JSON.
json compare(const std::string& name, const char* kind, const std::vector<ray>& rays,
             const reference::tracer<float>& ours, const embree_peer* peer, int repeat) {
  std::vector<hit> hits(rays.size()), peer_hits(rays.size());
  std::vector<double> times, peer_times, ratios;
  for (int i = 0; i < repeat; ++i) {
    times.push_back(seconds([&] {
      for (std::size_t k = 0; k < rays.size(); ++k) hits[k] = ours.closest(rays[k]);
    }));
    if (!peer) continue;
    peer_times.push_back(seconds([&] { peer->closest(rays, peer_hits); }));
    ratios.push_back(peer_times.back() / times.back());
  }
  json row{{"mesh", name}, {"rays", kind}, {"count", rays.size()}};
  row["reference"] = figures(times, rays.size());
  std::printf("%-24s %-8s %9zu  %6.2f (%.2f-%.2f)", name.c_str(), kind, rays.size(),
              double(row["reference"]["mrays_per_s"]),
              double(row["reference"]["mrays_per_s_least"]),
              double(row["reference"]["mrays_per_s_most"]));
  if (peer) {
    std::size_t differ = 0;
    for (std::size_t k = 0; k < rays.size(); ++k) differ += bool(hits[k]) != bool(peer_hits[k]);
    const study::summary ratio = study::summarize(ratios);
    row["embree"] = figures(peer_times, rays.size());
    row["ratio"] = {{"median", ratio.median}, {"least", ratio.least}, {"most", ratio.most}};
    row["hit_or_miss_differs"] = differ;
    std::printf("  %6.2f  %.2f (%.2f-%.2f)  %zu", double(row["embree"]["mrays_per_s"]),
                ratio.median, ratio.least, ratio.most, differ);
  }
  std::printf("\n");
  std::fflush(stdout);
  return row;
}

void run(const settings& o) {
  std::vector<std::string> names = o.models;
  if (o.terrain > 0) names.push_back("terrain:" + std::to_string(o.terrain));
  if (o.soup > 0) names.push_back("soup:" + std::to_string(o.soup));
  if (o.models.empty()) std::printf("No --model given: OBJ meshes are left out.\n");

  const std::string peer_name = embree_version();
  if (peer_name.empty())
    std::printf("Built without Embree (libembree-dev): its figures are left out.\n");
  json report = head_of("facet-bench-reference", study::origin_now());
  report["settings"] = {{"repeats", o.repeat}, {"compiler", __VERSION__}};
  report["peer"] = peer_of(peer_name, 1);
  report["results"] = json::array();
  report["builds"] = json::array();

  std::printf("Closest hits on one thread, Mrays/s: median (least-most)%s\n",
              peer_name.empty() ? "" : "; Embree; ratio; hit in one and miss in the other");
  const std::vector<ray> primary = primary_rays();
  for (const std::string& path : names) {
    const std::string name = name_of(path);
    const scene s = scene_of(load_workload(path));
    std::unique_ptr<reference::tracer<float>> ours;
    const double build = seconds([&] { ours = std::make_unique<reference::tracer<float>>(s); });
    std::unique_ptr<embree_peer> peer;
    if (!peer_name.empty()) peer = std::make_unique<embree_peer>(s.meshes[0], 1);
    report["builds"].push_back({{"mesh", name},
                                {"triangles", s.triangle_count()},
                                {"reference_s", build},
                                {"embree_s", peer ? json(peer->build_seconds()) : json()}});

    std::vector<hit> hits;
    for (const ray& r : primary) hits.push_back(ours->closest(r));
    const std::vector<ray> bounce = bounce_rays(s.meshes[0], primary, hits);
    auto& results = report["results"];
    results.push_back(compare(name, "primary", primary, *ours, peer.get(), o.repeat));
    results.push_back(compare(name, "bounce", bounce, *ours, peer.get(), o.repeat));
  }
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_reference_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row = app.add_subcommand("reference", "Serial reference against Embree, closest hits");
  row->add_option("--model", o->models, "OBJ files to trace, too; none: only generated meshes")
      ->check(CLI::ExistingFile);
  row->add_option("--terrain", o->terrain, "terrain of 2*N*N triangles; 0 leaves it out")
      ->check(CLI::Range(0, 8000))
      ->capture_default_str();
  row->add_option("--soup", o->soup, "N random triangles; 0 leaves it out")
      ->check(CLI::Range(0, 100000000))
      ->capture_default_str();
  row->add_option("--repeat", o->repeat, "runs of each figure, alternated with the peer's")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--threads", "the reference is serial: only 1")
      ->check(CLI::Range(1, 1))
      ->expected(1);
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
