#include <nlohmann/json.hpp>

#include "bench/growth.hpp"
#include "study/result_json.hpp"

namespace facet::bench {
namespace {

using json = nlohmann::ordered_json;

json to_json(const growth_figure& f) {
  json j{{"rays", f.rays}, {"count", f.count}, {"warm_up_ms", f.warm_up_ms}};
  if (f.differing_hits) j["differing_hits"] = *f.differing_hits;
  j["time"] = study::to_json(f.time);
  return j;
}

json to_json(const growth_point& p) {
  json figures = json::array();
  for (const growth_figure& f : p.figures) figures.push_back(to_json(f));
  return {{"mesh", p.mesh},
          {"triangles", p.triangles},
          {"scene_hash", p.scene_hash},
          {"geometry", p.geometry},
          {"tree_depth", p.tree_depth},
          {"device_bytes", p.device_bytes},
          {"compile_ms", p.compile_ms},
          {"upload_ms", p.upload_ms},
          {"build", study::to_json(p.build)},
          {"figures", std::move(figures)}};
}

json to_json(const growth_series& s) {
  json points = json::array();
  for (const growth_point& p : s.points) points.push_back(to_json(p));
  json ended;
  if (s.ended) ended = {{"triangles", s.ended->triangles}, {"reason", s.ended->reason}};
  return {{"way", word_of(s.by)}, {"points", std::move(points)}, {"ended", std::move(ended)}};
}

json to_json(const growth_settings& s) {
  return {
      {"families", s.families},
      {"triangles", s.triangles},
      {"picture", {{"width", s.width}, {"height", s.height}}},
      {"repeats", s.repeats},
      {"warm_ups", 1},
      {"builds", s.builds},
      {"budget_s", s.budget_s},
      {"geometry", s.geometry},
      {"bootstrap",
       {{"resamples", s.drawing.resamples}, {"level", s.drawing.level}, {"seed", s.drawing.seed}}}};
}

}  // namespace

json to_json(const growth_result& r) {
  json families = json::array();
  for (const growth_family& f : r.families) {
    json series = json::array();
    for (const growth_series& s : f.series) series.push_back(to_json(s));
    families.push_back({{"family", f.name}, {"series", std::move(series)}});
  }
  json j = head_of("facet-growth", r.from);
  j["complete"] = r.complete;
  j["settings"] = to_json(r.settings);
  j["kernel"] = {{"text_hash", r.kernel_hash}};
  j["families"] = std::move(families);
  return j;
}

}  // namespace facet::bench
