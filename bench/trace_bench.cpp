// Row `trace`: primary, shadow and bounce rays on an OpenCL device (event times), beside Embree on
// the CPU's threads, the same rays, alternated in one run.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "bench/embree_peer.hpp"
#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/stream_choice.hpp"
#include "runtime/runtime.hpp"
#include "study/statistics.hpp"
#include "study/tree_makers.hpp"
#include "study/tuning_table.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

struct settings {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"}, peers{"single", "packets"},
      kinds{"primary", "shadow", "bounce"};
  std::string device = "0", geometry = "auto", tree = "binned", layout = "auto", packets = "auto",
              refill = "auto", kernels, tuning, json;
  tracer::stream_kind streams = tracer::stream_kind::automatic;
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

/// A way to ask Embree, and what it took.
struct peer {
  std::string name;
  std::unique_ptr<embree_peer> on;
  embree_calls calls;
  std::vector<double> times{}, ratios{};
  std::vector<hit> hits{};
};

std::vector<peer> peers_of(const mesh& m, const settings& o) {
  std::vector<peer> all;
  if (embree_version().empty()) return all;
  for (const std::string& name : o.peers)
    all.push_back({name, std::make_unique<embree_peer>(m, o.threads, name.starts_with("robust")),
                   name.ends_with("packets") ? embree_calls::packets : embree_calls::single});
  return all;
}

/// Prints one peer's part of a line; its figures as JSON.
json figures_of(const peer& p, const std::vector<tracer::hit>& hits) {
  std::size_t differ = 0;
  for (std::size_t k = 0; k < hits.size(); ++k)
    differ += (hits[k].triangle != tracer::miss) != bool(p.hits[k]);
  const study::summary ratio = study::summarize(p.ratios);
  json j{{"way", p.name}, {"embree", rates(p.times, hits.size())}};
  j["ratio"] = {{"median", ratio.median}, {"least", ratio.least}, {"most", ratio.most}};
  j["hit_or_miss_differs"] = differ;
  std::printf("  %-8s %7.2f  %.2f (%.2f-%.2f)  %zu", p.name.c_str(),
              double(j["embree"]["mrays_per_s"]), ratio.median, ratio.least, ratio.most, differ);
  return j;
}

/// One kind of rays: times all in turn, prints a line, gives it as JSON, and the device's hits.
json measure(const std::string& name, const char* kind, const std::vector<ray>& rays, bool any,
             tracer::device_scene& ours, std::vector<peer>& peers, const settings& o,
             std::vector<tracer::hit>& hits) {
  const std::vector<tracer::ray> input = packed(rays);
  std::vector<double> times;
  bool is_refilled = false, is_streamed = false;
  for (peer& p : peers) p.times.clear(), p.ratios.clear(), p.hits.resize(rays.size());
  // Without peers all repeats are one call. With some they take turns, and each one's first pass
  // only brings back into the caches what the one before has driven out.
  for (int i = 0; i < (peers.empty() ? 1 : o.repeat); ++i) {
    tracer::statistics s;
    hits = ours.trace(input, any, 1 + (peers.empty() ? unsigned(o.repeat) : 1), &s);
    is_refilled = s.is_refilled, is_streamed = s.is_streamed;
    for (std::size_t k = 1; k < s.kernel_ms.size(); ++k) times.push_back(s.kernel_ms[k] * 1e-3);
    for (peer& p : peers) {
      const auto pass = [&] { p.on->trace(rays, any, o.threads, p.hits, p.calls); };
      pass();
      p.times.push_back(seconds(pass));
      p.ratios.push_back(p.times.back() / times.back());
    }
  }
  json row{{"mesh", name},
           {"rays", kind},
           {"count", rays.size()},
           {"refilled", is_refilled},
           {"streamed", is_streamed}};
  row["facet"] = rates(times, rays.size());
  std::printf("%-22s %-8s%s %8zu  %9.2f (%.2f-%.2f)", name.c_str(), kind,
              is_refilled ? ", refilled" : "", rays.size(), double(row["facet"]["mrays_per_s"]),
              double(row["facet"]["mrays_per_s_least"]), double(row["facet"]["mrays_per_s_most"]));
  for (const peer& p : peers) row["peers"].push_back(figures_of(p, hits));
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
  options.packets = o.packets == "on"    ? tracer::packet_kind::on
                    : o.packets == "off" ? tracer::packet_kind::off
                                         : tracer::packet_kind::automatic;
  options.refill = o.refill == "on"    ? tracer::refill_kind::on
                   : o.refill == "off" ? tracer::refill_kind::off
                                       : tracer::refill_kind::automatic;
  options.streams = o.streams;
  options.kernel_folder = o.kernels;
  if (!o.tuning.empty()) options.defaults = study::tuned_values(o.tuning, device);
  const std::string peer_name = embree_version();
  json report = head_of("facet-bench-trace", study::origin_now(device));
  report["settings"] = {{"repeats", o.repeat},
                        {"tree", o.tree},
                        {"geometry", o.geometry},
                        {"layout", o.layout},
                        {"tuned", options.defaults.has_value()}};
  report["peer"] = peer_of(peer_name, o.threads);
  report["results"] = json::array();
  report["builds"] = json::array();
  std::printf(
      "Mrays/s: median (least-most)%s\n",
      peer_name.empty()
          ? "; built without Embree: its figures are left out"
          : "; of each way to ask Embree: its rate; ratio; hit in one and miss in the other");
  const std::vector<ray> primary = primary_rays();
  for (const std::string& path : o.meshes) {
    const std::string name = name_of(path);
    const scene s = scene_of(load_workload(path));
    std::vector<tracer::given_tree> given;
    if (maker && !maker->kind)
      given.push_back(study::made_by(*maker, tracer::pack(s, false).corners));
    tracer::device_scene ours(queue, s, options, given);
    std::vector<peer> peers = peers_of(s.meshes[0], o);

    auto& results = report["results"];
    const auto measured = [&](const char* kind, const std::vector<ray>& rays, bool any) {
      std::vector<tracer::hit> found;
      if (std::ranges::find(o.kinds, kind) != o.kinds.end())
        results.push_back(measure(name, kind, rays, any, ours, peers, o, found));
      return found;
    };
    std::vector<tracer::hit> hits = measured("primary", primary, false);
    if (hits.empty()) hits = ours.trace(packed(primary));  // where the others start
    std::vector<hit> met;
    for (const tracer::hit& h : hits) met.push_back({h.t, h.u, h.v, h.instance, h.triangle});
    const std::vector<ray> shadow = shadow_rays(s.meshes[0], primary, met);
    const std::vector<ray> bounce = bounce_rays(s.meshes[0], primary, met);
    measured("shadow", shadow, true);
    measured("bounce", bounce, false);

    tracer::statistics st;
    ours.trace({}, false, 1, &st);
    report["builds"].push_back({{"mesh", name},
                                {"triangles", s.triangle_count()},
                                {"geometry", st.geometry},
                                {"layout", st.layout},
                                {"rays_a_work_item", st.rays_a_work_item},
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
  row->add_option("--rays", o->kinds, "kinds of rays")
      ->check(CLI::IsMember({"primary", "shadow", "bounce"}))
      ->capture_default_str();
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
  row->add_option("--packets", o->packets, "rays traced together where they stay close")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  row->add_option("--refill", o->refill, "warps take new rays while others are on their way")
      ->check(CLI::IsMember({"auto", "on", "off"}))
      ->capture_default_str();
  add_streams_option(*row, o->streams);
  row->add_option("--kernels", o->kernels, "read cl/ from this folder");
  row->add_option("--tuning", o->tuning,
                  "a table of `facet tune`, in place of the built-in defaults");
  row->add_option("--repeat", o->repeat, "runs of each figure, alternated with the peer's")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--peers", o->peers, "ways to ask Embree")
      ->check(CLI::IsMember({"single", "packets", "robust-single", "robust-packets"}))
      ->capture_default_str();
  row->add_option("--threads", o->threads, "threads that Embree traces with")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
