// Row `fold`: from a finished binary tree to the wide layout on the device, step by step.
#include <cstdio>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/measure.hpp"
#include "bench/result_file.hpp"
#include "bench/rows.hpp"
#include "bench/workload.hpp"
#include "image/output.hpp"
#include "study/statistics.hpp"
#include "study/tree_makers.hpp"
#include "tracer/blocks.hpp"
#include "tracer/cut_tree.hpp"
#include "tracer/fold.hpp"
#include "tracer/kernels.hpp"
#include "tracer/node_trees.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;
using tracer::texel;

struct arguments {
  std::vector<std::string> meshes{"terrain:1000", "soup:1000000"};
  std::vector<std::string> trees{"binned"};
  std::string device = "0", flags, json;
  int repeat = 11;
};

/// Times by step, in milliseconds, and what came out.
struct fold_times {
  std::map<std::string, std::vector<double>> step;
  std::uint32_t binary_nodes = 0, nodes = 0, blocks = 0, depth = 0;
};

/// Into memory that the run before has used, but for the first.
fold_times measure(runtime::queue& q, const mesh& m, tracer::tree_kind kind, int repeats,
                   const std::string& flags) {
  tracer::tuning t = tracer::tuning_for(q.get_device());
  t.more_flags = flags;
  t.build_alone();  // as on CPUs, for which the wide layout is
  tracer::node_trees trees(q, tracer::kernel_sources(), t, kind, tracer::block_leaves);
  tracer::folder folder(q, tracer::kernel_sources(), t);
  tracer::block_maker maker(q, tracer::kernel_sources(), t);
  const tracer::packed_scene packed = tracer::pack(scene_of(m), false);
  const auto triangles = packed.world.triangle_count;
  runtime::buffer<texel> corners(packed.corners.data(), packed.corners.size());
  const runtime::buffer<std::uint32_t> materials(packed.triangle_materials.data(), triangles);
  q.wait_and_throw();

  fold_times times;
  std::unique_ptr<runtime::buffer<tracer::WideNode>> wide;
  std::unique_ptr<tracer::block_list> list;
  std::unique_ptr<runtime::buffer<texel>> blocks;
  std::unique_ptr<runtime::buffer<tracer::TriangleInfo>> infos;
  for (int i = 0; i <= repeats; ++i) {
    const auto timed = [&](const char* step, const std::function<void()>& work) {
      const double s = seconds([&] { work(), q.wait_and_throw(); });
      times.step[i == 0 ? std::string("first ") + step : step].push_back(1e3 * s);
    };
    std::unique_ptr<tracer::node_tree> tree;
    std::unique_ptr<tracer::fold_plan> plan;
    timed("tree", [&] {
      tree = std::make_unique<tracer::node_tree>(trees.over_triangles(corners, triangles));
    });
    timed("plan", [&] { plan = std::make_unique<tracer::fold_plan>(folder.plan(*tree)); });
    if (i == 0) {
      times.binary_nodes = tree->node_count;
      times.nodes = plan->nodes, times.blocks = plan->leaves, times.depth = plan->depth;
      wide = std::make_unique<runtime::buffer<tracer::WideNode>>(plan->nodes);
      list = std::make_unique<tracer::block_list>(tracer::block_list{
          runtime::buffer<std::uint32_t>(plan->leaves), tree->order, plan->leaves});
      blocks = std::make_unique<runtime::buffer<texel>>(
          plan->leaves * (sizeof(tracer::TriangleBlock) / sizeof(texel)));
      infos = std::make_unique<runtime::buffer<tracer::TriangleInfo>>(std::size_t(FACET_BLOCK) *
                                                                      plan->leaves);
    }
    timed("emit", [&] { folder.emit(*tree, *plan, *wide, 0, list->leaves, 0); });
    timed("blocks", [&] { maker.make(*list, corners, materials, *blocks, *infos, 0); });
  }
  return times;
}

void run(const arguments& o) {
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::device device = runtime::select_device(o.device);
  runtime::queue queue(device);
  json report = head_of("facet-bench-fold", study::origin_now(device));
  report["settings"] = {{"repeats", o.repeat}};
  report["results"] = json::array();
  std::printf("ms by the host's clock: median (least-most); the first run allocates\n");
  for (const std::string& path : o.meshes) {
    const std::string name = name_of(path);
    const mesh m = load_workload(path);
    for (const std::string& builder : o.trees) {
      const fold_times t =
          measure(queue, m, *study::tree_maker_of(builder)->kind, o.repeat, o.flags);
      json row{{"mesh", name},
               {"builder", builder},
               {"triangles", m.triangle_count()},
               {"binary_nodes", t.binary_nodes},
               {"nodes", t.nodes},
               {"blocks", t.blocks},
               {"depth", t.depth}};
      std::printf("%-22s %s: %zu triangles, %u binary nodes, %u wide ones, %u blocks, depth %u\n",
                  name.c_str(), builder.c_str(), std::size_t(m.triangle_count()), t.binary_nodes,
                  t.nodes, t.blocks, t.depth);
      for (const char* step : {"tree", "plan", "emit", "blocks"}) {
        const study::summary s = study::summarize(t.step.at(step));
        const double first = t.step.at(std::string("first ") + step)[0];
        row["ms"][step] = {{"median", s.median},
                           {"least", s.least},
                           {"most", s.most},
                           {"first", first},
                           {"samples", t.step.at(step)}};
        std::printf("%22s %9.2f (%.2f-%.2f), first %.2f\n", step, s.median, s.least, s.most, first);
      }
      report["results"].push_back(row);
    }
  }
  if (!o.json.empty()) write_result(o.json, report);
}

}  // namespace

void add_fold_row(CLI::App& app) {
  auto o = std::make_shared<arguments>();
  CLI::App* row = app.add_subcommand("fold", "From a binary tree to the wide layout, on a device");
  row->add_option("--mesh", o->meshes, "OBJ files, terrain:N or soup:N")->capture_default_str();
  row->add_option("--tree", o->trees, "builders")
      ->delimiter(',')
      ->check(CLI::IsMember({"levels", "binned"}))
      ->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--repeat", o->repeat, "timed runs, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--flags", o->flags, "for the kernels' compiler");
  row->add_option("--json", o->json, "write the figures to this file");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
