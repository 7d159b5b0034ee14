// Row `limits`: what stands between the rates of tracing and the device. Of each kind of rays:
// nodes and triangles a ray, how evenly neighbours share them, and the rate beside two others: that
// of rays which do not part, and those of the device's arithmetic and memory alone.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/chip_rates.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "image/output.hpp"
#include "runtime/runtime.hpp"
#include "study/statistics.hpp"
#include "study/visits.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

constexpr std::size_t warp = 32;  ///< rays that go in step on a GPU: neighbours in the buffer

struct settings {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"};
  std::string device = "0", json;
  unsigned repeat = 5;
};

/// Of every 32 rays one, 32 times over: none of a warp parts from the others.
std::vector<tracer::ray> alike(const std::vector<tracer::ray>& rays) {
  std::vector<tracer::ray> same;
  for (std::size_t k = 0; k < rays.size(); ++k) same.push_back(rays[k - k % warp]);
  return same;
}

/// Of the work-items of warps, the share that has a visit to make, were all visits as long: the
/// mean of a warp's visits to its longest ray's.
double lanes_in_use(const std::vector<study::visits>& counted) {
  double made = 0, room = 0;
  for (std::size_t k = 0; k < counted.size(); k += warp) {
    std::uint32_t longest = 0;
    const std::size_t end = std::min(k + warp, counted.size());
    for (std::size_t i = k; i < end; ++i) {
      made += counted[i].total();
      longest = std::max(longest, counted[i].total());
    }
    room += double(longest) * double(end - k);
  }
  return made / room;
}

struct load {
  double nodes, triangles;  ///< a ray
};

load load_of(const std::vector<study::visits>& counted) {
  load sum{};
  for (const study::visits& v : counted) sum.nodes += v.nodes, sum.triangles += v.triangles;
  return {sum.nodes / double(counted.size()), sum.triangles / double(counted.size())};
}

/// Rays a second, median.
double rate(tracer::device_scene& on, const std::vector<tracer::ray>& rays, bool any,
            unsigned repeat) {
  tracer::statistics s;
  on.trace(rays, any, 1 + repeat, &s);
  s.kernel_ms.erase(s.kernel_ms.begin());
  return double(rays.size()) / (1e-3 * study::summarize(s.kernel_ms).median);
}

/// What one mesh is traced with: as it is, and counting.
struct tracers {
  tracer::device_scene plain, counting;
  study::visit_bytes bytes;
};

json measure(const std::string& mesh, const char* kind, const std::vector<tracer::ray>& rays,
             bool any, tracers& by, const chip_rates& chip, unsigned repeat) {
  const std::vector<study::visits> counted = study::count_visits(by.counting, rays, any);
  const load l = load_of(counted);
  const std::vector<tracer::ray> same = alike(rays);
  const load same_load = load_of(study::count_visits(by.counting, same, any));
  const double found = rate(by.plain, rays, any, repeat),
               of_same = rate(by.plain, same, any, repeat);
  const double visits = l.nodes + l.triangles, same_visits = same_load.nodes + same_load.triangles;
  const double bytes = l.nodes * by.bytes.node + l.triangles * by.bytes.triangle;
  const double in_use = lanes_in_use(counted);
  const double of_alike = found * visits / (of_same * same_visits);
  // Arithmetic that the device could have done in the time of a visit, where rays do not part.
  const double operations = chip.operations_per_s / (of_same * same_visits);
  std::printf("%-16s %-7s %8.1f %8.1f %7.0f%% %10.0f %10.0f %8.2f %9.1f %9.0f", mesh.c_str(), kind,
              l.nodes, l.triangles, 100 * in_use, 1e-6 * found, 1e-6 * of_same, of_alike,
              operations, 1e-9 * found * bytes);
  json row{{"mesh", mesh},
           {"rays", kind},
           {"count", rays.size()},
           {"nodes_a_ray", l.nodes},
           {"triangles_a_ray", l.triangles},
           {"bytes_a_ray", bytes},
           {"lanes_in_use", in_use},
           {"mrays_per_s", 1e-6 * found},
           {"alike",
            {{"nodes_a_ray", same_load.nodes},
             {"triangles_a_ray", same_load.triangles},
             {"mrays_per_s", 1e-6 * of_same},
             {"operations_a_visit", operations}}},
           {"of_alike", of_alike},
           {"gbytes_per_s", 1e-9 * found * bytes},
           {"of_gathers", json::array()}};
  for (const gather_rate& g : chip.gathers) {
    const double share = found * bytes / (64 * g.nodes_per_s);
    row["of_gathers"].push_back(share);
    std::printf(" %5.0f%%", 100 * share);
  }
  std::printf("\n");
  std::fflush(stdout);
  return row;
}

json to_json(const chip_rates& chip) {
  json j{{"operations_per_s", chip.operations_per_s}, {"gathers", json::array()}};
  for (const gather_rate& g : chip.gathers)
    j["gathers"].push_back({{"bytes", g.bytes},
                            {"nodes_per_s", g.nodes_per_s},
                            {"gbytes_per_s", 64e-9 * g.nodes_per_s}});
  return j;
}

void print(const chip_rates& chip) {
  std::printf("fused multiply-adds: %.0f billion a second\n", 1e-9 * chip.operations_per_s);
  for (const gather_rate& g : chip.gathers)
    std::printf("nodes of 64 bytes, anywhere in %6.0f KiB: %.1f billion a second, %.0f GB/s\n",
                double(g.bytes) / 1024, 1e-9 * g.nodes_per_s, 64e-9 * g.nodes_per_s);
  std::printf("%-16s %-7s %8s %8s %8s %10s %10s %8s %9s %9s  of each gather's bytes\n", "mesh",
              "rays", "nodes", "triang.", "in use", "Mrays/s", "alike", "of them", "ops/visit",
              "GB/s");
}

void run(const settings& o) {
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = runtime::select_device(o.device);
  const runtime::queue queue(device);
  json report = head_of("facet-bench-limits", study::origin_now(device));
  report["settings"] = {{"repeats", o.repeat}};
  const chip_rates chip = measure_chip(queue, o.repeat);
  print(chip);
  report["chip"] = to_json(chip);
  report["results"] = json::array();
  const std::vector<ray> primary = primary_rays();
  for (const std::string& path : o.meshes) {
    const scene s = scene_of(load_workload(path));
    tracer::options options;
    options.packets = tracer::packet_kind::off;
    tracers by{{queue, s, options}, {queue, s, study::counting_visits(options)}, {}};
    by.bytes = study::visit_bytes_of(by.plain.prepared().layout);
    std::vector<hit> met;
    for (const tracer::hit& h : by.plain.trace(packed(primary)))
      met.push_back({h.t, h.u, h.v, h.instance, h.triangle});
    const auto add = [&](const char* kind, const std::vector<ray>& rays, bool any) {
      report["results"].push_back(
          measure(name_of(path), kind, packed(rays), any, by, chip, o.repeat));
    };
    add("primary", primary, false);
    add("shadow", shadow_rays(s.meshes[0], primary, met), true);
    add("bounce", bounce_rays(s.meshes[0], primary, met), false);
  }
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_limits_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row = app.add_subcommand(
      "limits", "What rays visit, against rays that do not part and the device's own rates");
  row->add_option("--mesh", o->meshes, "OBJ files, terrain:N or soup:N")->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--repeat", o->repeat, "timed runs of each figure, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
