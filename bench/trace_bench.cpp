// Row `trace`: primary, shadow and bounce rays on an OpenCL device (event times), beside Embree on
// the CPU's threads, the same rays, alternated in one run.
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/embree_peer.hpp"
#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "runtime/runtime.hpp"
#include "study/statistics.hpp"
#include "study/tree_makers.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"};
  std::string device = "0", geometry = "auto", tree = "binned", layout = "auto", kernels, json;
  int repeat = 5;
  unsigned threads = std::thread::hardware_concurrency();
};

json rates(const std::vector<double>& seconds, std::size_t rays) {
  std::vector<double> rate;
  for (double s : seconds) rate.push_back(double(rays) / s * 1e-6);
  const study::summary r = study::summarize(rate);
  return {{"mrays_per_s", r.median},
          {"mrays_per_s_least", r.least},
          {"mrays_per_s_most", r.most},
          {"seconds", seconds}};
}

/// One kind of rays: times both, prints a line, gives it as JSON, and the device's hits.
json measure(const std::string& name, const char* kind, const std::vector<ray>& rays, bool any,
             tracer::device_scene& ours, const embree_peer* peer, const settings& o,
             std::vector<tracer::hit>& hits) {
  const std::vector<tracer::ray> input = packed(rays);
  std::vector<hit> peer_hits(rays.size());
  std::vector<double> times, peer_times, ratios;
  // Without a peer all repeats are one call; with one, each is followed by the peer's.
  for (int i = 0; i < (peer ? o.repeat : 1); ++i) {
    tracer::statistics s;
    hits = ours.trace(input, any, peer ? 1 : unsigned(o.repeat), &s);
    for (double ms : s.kernel_ms) times.push_back(ms * 1e-3);
    if (!peer) continue;
    peer_times.push_back(seconds([&] { peer->trace(rays, any, o.threads, peer_hits); }));
    ratios.push_back(peer_times.back() / times.back());
  }
  json row{{"mesh", name}, {"rays", kind}, {"count", rays.size()}};
  row["facet"] = rates(times, rays.size());
  std::printf("%-22s %-8s %8zu  %9.2f (%.2f-%.2f)", name.c_str(), kind, rays.size(),
              double(row["facet"]["mrays_per_s"]), double(row["facet"]["mrays_per_s_least"]),
              double(row["facet"]["mrays_per_s_most"]));
  if (peer) {
    std::size_t differ = 0;
    for (std::size_t k = 0; k < rays.size(); ++k)
      differ += (hits[k].triangle != tracer::miss) != bool(peer_hits[k]);
    const study::summary ratio = study::summarize(ratios);
    row["embree"] = rates(peer_times, rays.size());
    row["ratio"] = {{"median", ratio.median}, {"least", ratio.least}, {"most", ratio.most}};
    row["hit_or_miss_differs"] = differ;
    std::printf("  %7.2f  %.2f (%.2f-%.2f)  %zu", double(row["embree"]["mrays_per_s"]),
                ratio.median, ratio.least, ratio.most, differ);
  }
  std::printf("\n");
  std::fflush(stdout);
  return row;
}

void run(const settings& o) {
  const runtime::device device = runtime::select_device(o.device);
  runtime::queue queue(device);
  tracer::options options;
  options.geometry = o.geometry == "image"    ? tracer::geometry_kind::image
                     : o.geometry == "buffer" ? tracer::geometry_kind::buffer
                                              : tracer::geometry_kind::automatic;
  const study::tree_maker* const maker = study::tree_maker_of(o.tree);
  options.tree =
      o.tree == "none" ? tracer::tree_kind::none : maker->kind.value_or(tracer::tree_kind::levels);
  options.layout = o.layout == "wide"     ? tracer::layout_kind::wide
                   : o.layout == "narrow" ? tracer::layout_kind::narrow
                                          : tracer::layout_kind::automatic;
  options.kernel_folder = o.kernels;
  const std::string peer_name = embree_version();
  json report = head_of("facet-bench-trace", study::origin_now(device));
  report["settings"] = {
      {"repeats", o.repeat}, {"tree", o.tree}, {"geometry", o.geometry}, {"layout", o.layout}};
  report["peer"] = peer_of(peer_name, o.threads);
  report["results"] = json::array();
  report["builds"] = json::array();
  std::printf("Mrays/s: median (least-most)%s\n",
              peer_name.empty() ? "; built without Embree: its figures are left out"
                                : "; Embree; ratio; hit in one and miss in the other");
  const std::vector<ray> primary = primary_rays();
  for (const std::string& path : o.meshes) {
    const std::string name = path.substr(path.find_last_of('/') + 1);
    const scene s = scene_of(load_workload(path));
    std::vector<tracer::given_tree> given;
    if (maker && !maker->kind)
      given.push_back(study::made_by(*maker, tracer::pack(s, false).corners));
    tracer::device_scene ours(queue, s, options, given);
    std::unique_ptr<embree_peer> peer;
    if (!peer_name.empty()) peer = std::make_unique<embree_peer>(s.meshes[0], o.threads);

    std::vector<tracer::hit> hits, ignored;
    auto& results = report["results"];
    results.push_back(measure(name, "primary", primary, false, ours, peer.get(), o, hits));
    std::vector<hit> met;
    for (const tracer::hit& h : hits) met.push_back({h.t, h.u, h.v, h.instance, h.triangle});
    const std::vector<ray> shadow = shadow_rays(s.meshes[0], primary, met);
    const std::vector<ray> bounce = bounce_rays(s.meshes[0], primary, met);
    results.push_back(measure(name, "shadow", shadow, true, ours, peer.get(), o, ignored));
    results.push_back(measure(name, "bounce", bounce, false, ours, peer.get(), o, ignored));

    tracer::statistics st;
    ours.trace({}, false, 1, &st);
    report["builds"].push_back({{"mesh", name},
                                {"triangles", s.triangle_count()},
                                {"geometry", st.geometry},
                                {"layout", st.layout},
                                {"build_ms", st.build_ms},
                                {"upload_ms", st.upload_ms},
                                {"compile_ms", st.compile_ms},
                                {"depth", st.tree_depth},
                                {"bytes", st.device_bytes}});
    std::printf("%-22s built in %.1f ms, compiled in %.0f ms, depth %u, on %s\n", name.c_str(),
                st.build_ms, st.compile_ms, st.tree_depth, st.device.c_str());
  }
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_trace_row(CLI::App& app) {
  auto o = std::make_shared<settings>();
  CLI::App* row =
      app.add_subcommand("trace", "Device against Embree: primary, shadow, bounce rays");
  row->add_option("--mesh", o->meshes, "OBJ files, terrain:N or soup:N")->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--geometry", o->geometry)
      ->check(CLI::IsMember({"auto", "image", "buffer"}))
      ->capture_default_str();
  row->add_option("--tree", o->tree, "sah and sweep: the reference's, made on the host")
      ->check(CLI::IsMember({"levels", "binned", "sah", "sweep", "none"}))
      ->capture_default_str();
  row->add_option("--layout", o->layout, "of nodes and triangles")
      ->check(CLI::IsMember({"auto", "narrow", "wide"}))
      ->capture_default_str();
  row->add_option("--kernels", o->kernels, "read cl/ from this folder");
  row->add_option("--repeat", o->repeat, "runs of each figure, alternated with the peer's")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--threads", o->threads, "threads that Embree traces with")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
