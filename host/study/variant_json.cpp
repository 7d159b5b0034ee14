#include "study/variant_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "study/json_text.hpp"
#include "study/result_json.hpp"

namespace facet::study {
namespace {

using json = nlohmann::ordered_json;

constexpr const char* set_names[] = {"eye", "bounce"};

const char* word_of(variant_state s) {
  switch (s) {
    case variant_state::measured:
      return "measured";
    case variant_state::refused:
      return "refused";
    case variant_state::unfinished:
      break;
  }
  return "unfinished";
}

json rate(double value) { return value > 0 ? json(value) : json(nullptr); }

json to_json(const hit_errors& e) {
  json histogram = json::array();
  for (std::size_t k = 0; k < e.ulps.size(); ++k)
    histogram.push_back({{"most", k == 0 ? 0 : std::uint64_t(1) << (k - 1)}, {"hits", e.ulps[k]}});
  json ulps{{"compared", e.compared}};
  if (e.compared > 0) {
    ulps["median"] = e.median_ulps;
    ulps["p99"] = e.p99_ulps;
    ulps["most"] = e.most_ulps;
  }
  ulps["histogram"] = std::move(histogram);
  return {{"wrong", e.wrong()},
          {"ties", e.ties},
          {"silhouettes", e.silhouettes},
          {"errors", e.errors},
          {"self_hits", e.self_hits},
          {"wrong_per_million", e.per_million(e.wrong())},
          {"errors_per_million", e.per_million(e.errors)},
          {"other_bits_than_strict", e.other_bits},
          {"first_errors", e.first_errors},
          {"t_ulps", std::move(ulps)}};
}

json to_json(const image::difference& d) {
  return {{"pixels", d.pixels()},
          {"max", d.max},
          {"mean", d.mean},
          {"rmse", d.rmse},
          {"psnr_db", std::isfinite(d.psnr) ? json(d.psnr) : json(nullptr)},
          {"off", d.pixels_off},
          {"nan_pixels", d.nan_pixels}};
}

json to_json(const picture_errors& e) {
  return {{"asked", e.asked},
          {"silhouettes", e.silhouettes},
          {"linear", {{"all", to_json(e.all)}, {"without_silhouettes", to_json(e.rest)}}},
          {"displayed",
           {{"off", e.all.pixels_off_displayed},
            {"off_at_silhouettes", e.off_displayed_explained},
            {"flip_mean", e.flip_mean},
            {"flip_max", e.flip_max}}},
          {"other_bits_than_strict", e.other_bits}};
}

json to_json(const variant_result& v, std::uint64_t pixels) {
  json j{{"name", v.of.name},
         {"family", v.of.family},
         {"about", v.of.about},
         {"state", word_of(v.state)}};
  if (!v.reason.empty()) j["reason"] = v.reason;
  j["max_depth"] = v.of.max_depth;
  j["promised_exact"] = v.of.is_exact;
  j["hits_of"] = v.of.is_shading_only ? "strict" : v.of.name;
  if (!v.is_judged) return j;
  j["repeatable"] = v.is_repeatable;
  j["kernel"] = {{"hash", v.kernel_hash},         {"text_hash", v.text_hash},
                 {"options", v.compiler_options}, {"features", v.features},
                 {"geometry", v.geometry},        {"largest_group", v.group_items}};
  j["tree"] = {{"kind", tracer::word_of(v.of.options.tree)},
               {"depth", v.tree_depth},
               {"nodes", v.tree_nodes}};
  j["device_bytes"] = v.device_bytes;
  j["compile_ms"] = v.compile_ms;
  j["upload_ms"] = v.upload_ms;
  j["build_ms"] = v.build_ms;
  j["warm_up_ms"] = v.warm_up_ms;
  const double ms = v.picture.values.median;
  j["picture"] = {{"kernel", to_json(v.picture)},
                  {"rays", v.rays},
                  {"mrays_per_s", rate(v.mrays_per_s())},
                  {"mpixels_per_s", rate(ms > 0 ? double(pixels) / ms * 1e-3 : 0)},
                  {"errors", to_json(v.picture_error)}};
  json hits = json::array();
  for (std::size_t k = 0; k < v.hits.size(); ++k)
    hits.push_back({{"rays", set_names[k]},
                    {"count", v.hits[k].errors.rays},
                    {"kernel", to_json(v.hits[k].kernel)},
                    {"mrays_per_s", rate(v.hits[k].mrays_per_s())},
                    {"errors", to_json(v.hits[k].errors)}});
  j["hits"] = std::move(hits);
  return j;
}

}  // namespace

std::string to_json(const variants_result& r) {
  const std::uint64_t pixels = std::uint64_t(r.settings.width) * r.settings.height;
  json variants = json::array(), order = json::array(), left_out = json::array();
  for (const variant_result& v : r.variants) variants.push_back(to_json(v, pixels));
  for (const std::uint32_t i : r.order) order.push_back(r.variants[i].of.name);
  for (const omitted_variant& o : r.left_out)
    left_out.push_back({{"variant", o.name}, {"reason", o.reason}});
  json file{{"format", "facet-variants"}, {"version", 1}, {"complete", r.complete}};
  file.update(to_json(r.from));
  file.update(
      json{{"settings",
            {{"repeats", r.settings.repeats},
             {"warm_ups", 1},
             {"seed", r.settings.seed},
             {"bootstrap", {{"resamples", r.settings.resamples}, {"level", r.settings.level}}},
             {"sideways_bound_in_u_reach", sideways_units}}},
           {"scene",
            {{"name", r.scene_name},
             {"hash", r.scene_hash},
             {"triangles", r.triangles},
             {"instances", r.instances}}},
           {"picture",
            {{"width", r.settings.width},
             {"height", r.settings.height},
             {"max_depth", r.max_depth},
             {"samples", r.samples}}},
           {"oracle_ms", r.oracle_ms},
           {"variants", std::move(variants)},
           {"left_out", std::move(left_out)},
           {"order", std::move(order)}});
  return json_text(file);
}

}  // namespace facet::study
