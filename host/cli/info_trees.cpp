#include "cli/info_trees.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/progress.hpp"
#include "image/output.hpp"
#include "study/json_text.hpp"
#include "study/tree_study.hpp"

namespace facet::cli {
namespace {

constexpr std::size_t shown = 20;  // meshes

std::string text(const char* format, double value) {
  char s[32];
  std::snprintf(s, sizeof s, format, value);
  return s;
}

/// "-" where there is nothing to be compared with.
std::string ratio(double of, double to) { return to > 0 ? text("%.3f", of / to) : "-"; }

std::string overlap_text(const study::end_point_overlap& o) {
  return text("%.3f", o.value) + (o.is_sampled ? text(" +-%.3f", o.standard_error) : "");
}

void print_line(const std::string& name, const study::measured_tree& t) {
  const study::tree_quality& q = t.as_traced;
  std::printf("  %-9s %8.2f %7s %8.2f %7s %7.2f %15s %7s %6u %10llu %10llu %7.2f %5u %8.1f\n",
              name.c_str(), t.binary_cost, ratio(t.binary_cost, t.sweep_binary_cost).c_str(),
              q.sah_cost, ratio(q.sah_cost, t.sweep_cost).c_str(), q.visits,
              overlap_text(t.overlap).c_str(), ratio(t.overlap.value, t.sweep_overlap).c_str(),
              q.depth, static_cast<unsigned long long>(q.inner_nodes),
              static_cast<unsigned long long>(q.leaves), q.primitives_a_leaf(), q.most_in_leaf,
              q.bytes_a_primitive);
}

void print_mesh(const study::trees_result& r, std::size_t k) {
  std::printf("%s, %llu triangles; the full sweep's costs: binary %.2f, %s %.2f\n",
              r.meshes[k].name.c_str(), static_cast<unsigned long long>(r.meshes[k].triangles),
              r.makers[0].meshes[k].sweep_binary_cost, r.makers[0].layout.c_str(),
              r.makers[0].meshes[k].sweep_cost);
  for (const study::maker_result& m : r.makers) print_line(m.maker, m.meshes[k]);
}

void print_table(const study::trees_result& r) {
  std::printf("  %-9s %8s %7s %8s %7s %7s %15s %7s %6s %10s %10s %7s %5s %8s\n", "tree", "binary",
              "/sweep", r.makers[0].layout.c_str(), "/sweep", "visits", "overlap", "/sweep",
              "depth", "nodes", "leaves", "a leaf", "most", "bytes/t");
  for (std::size_t k = 0; k < r.meshes.size() && k < shown; ++k) print_mesh(r, k);
  if (r.meshes.size() > shown)
    std::printf("... and %zu more meshes, which the file of --json has\n", r.meshes.size() - shown);
  for (const study::maker_result& m : r.makers)
    if (m.top)
      std::printf("top over %llu instances, %s: SAH cost %.2f, depth %u, %llu nodes\n",
                  static_cast<unsigned long long>(m.top->primitives), m.maker.c_str(),
                  m.top->sah_cost, m.top->depth,
                  static_cast<unsigned long long>(m.top->inner_nodes));
  std::printf(
      "binary: SAH cost of the tree that the layout is folded from, with the best leaves of up to\n"
      "%u triangles; %s: SAH cost of the nodes as they are traced. A node and a triangle cost 1.\n"
      "/sweep: by that of the full sweep's tree in the same form. visits: the cost as traced if a "
      "leaf\n"
      "is 1, as the wide layout tests it. overlap: end-point overlap (Aila, Karras and Laine "
      "2013)%s.\n"
      "bytes/t: what rays may read, a triangle.\n",
      r.settings.most_in_leaf, r.makers[0].layout.c_str(),
      r.makers[0].meshes.empty() || !r.makers[0].meshes[0].overlap.is_sampled
          ? ""
          : ",\n+- a standard error");
}

}  // namespace

void print_trees(const scene& s, const trees_request& r, const console& say) {
  if (!r.json.empty()) image::check_output(r.json);
  const runtime::device device = choose_device(r.device, say);
  study::tree_settings settings;
  settings.makers = r.builders;
  settings.tracer = r.tracer;
  settings.samples = r.samples;
  settings.seed = r.seed;
  const study::trees_result found = [&] {
    progress_bar bar("measuring trees", say.quiet);
    return study::measure_trees(runtime::queue(device), s, settings,
                                [&](std::uint64_t done, std::uint64_t total) {
                                  stop_if_interrupted("measuring; nothing was written");
                                  bar.update(done, total);
                                });
  }();
  if (found.meshes.empty()) {
    say.say("no triangle is shown, so there is no tree");
  } else {
    print_table(found);
  }
  if (r.json.empty()) return;
  image::write_file(r.json, study::json_text(study::to_json(found)));
  say.say("wrote " + r.json);
}

}  // namespace facet::cli
