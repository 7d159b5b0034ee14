#include <nlohmann/json.hpp>

#include "study/result_json.hpp"
#include "study/tree_study.hpp"

namespace facet::study {
namespace {

using json = nlohmann::ordered_json;

const char* word_of(tracer::layout_kind l) {
  switch (l) {
    case tracer::layout_kind::narrow:
      return "narrow";
    case tracer::layout_kind::wide:
      return "wide";
    case tracer::layout_kind::automatic:
      break;
  }
  return "auto";
}

/// Null where there is nothing to be compared with.
json ratio(double of, double to) { return to > 0 ? json(of / to) : json(nullptr); }

json to_json(const tree_quality& q) {
  return {{"sah_cost", q.sah_cost},
          {"visits", q.visits},
          {"inner_nodes", q.inner_nodes},
          {"leaves", q.leaves},
          {"depth", q.depth},
          {"primitives", q.primitives},
          {"primitives_a_leaf", q.primitives_a_leaf()},
          {"most_in_leaf", q.most_in_leaf},
          {"bytes_a_primitive", q.bytes_a_primitive}};
}

json to_json(const end_point_overlap& o) {
  return {{"value", o.value},
          {"standard_error", o.standard_error},
          {"triangles", o.triangles},
          {"sampled", o.is_sampled}};
}

json to_json(const measured_tree& t) {
  json j = to_json(t.as_traced);
  j["sah_cost_over_sweep"] = ratio(t.as_traced.sah_cost, t.sweep_cost);
  j["end_point_overlap"] = to_json(t.overlap);
  j["end_point_overlap_over_sweep"] = ratio(t.overlap.value, t.sweep_overlap);
  j["binary"] = {{"sah_cost", t.binary_cost},
                 {"sweep_sah_cost", t.sweep_binary_cost},
                 {"sah_cost_over_sweep", ratio(t.binary_cost, t.sweep_binary_cost)}};
  return j;
}

}  // namespace

json to_json(const trees_result& r) {
  json meshes = json::array(), makers = json::array();
  for (const trees_result::mesh_facts& m : r.meshes)
    meshes.push_back({{"name", m.name}, {"triangles", m.triangles}});
  for (const maker_result& m : r.makers) {
    json trees = json::array();
    for (const measured_tree& t : m.meshes) trees.push_back(to_json(t));
    makers.push_back({{"builder", m.maker},
                      {"layout", m.layout},
                      {"device_bytes", m.device_bytes},
                      {"meshes", std::move(trees)},
                      {"top", m.top ? to_json(*m.top) : json(nullptr)}});
  }
  json j{{"format", "facet-trees"}, {"version", 1}};
  j.update(to_json(r.from));
  j["settings"] = {{"builders", r.settings.makers},
                   {"layout", word_of(r.settings.tracer.layout)},
                   {"samples", r.settings.samples},
                   {"seed", r.settings.seed},
                   {"most_in_binary_leaf", r.settings.most_in_leaf}};
  j["scene"] = {{"name", r.scene_name}, {"hash", r.scene_hash}, {"meshes", std::move(meshes)}};
  j["builders"] = std::move(makers);
  return j;
}

}  // namespace facet::study
