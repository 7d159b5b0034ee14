#include "study/tuning_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "scene/text_file.hpp"
#include "study/json_text.hpp"
#include "study/result_json.hpp"

namespace facet::study {
namespace {

using json = nlohmann::ordered_json;

/// Figures that one reads, not computes with: four digits.
double rounded(double x) {
  if (x == 0 || !std::isfinite(x)) return x;
  const double unit = std::pow(10.0, 3 - std::floor(std::log10(std::abs(x))));
  return std::round(x * unit) / unit;
}

json to_json(const tuned_device& d) {
  return {{"name", d.name}, {"platform", d.platform}, {"driver", d.driver}};
}

json to_json(const tracer::choices& c) {
  return {{"layout", c.wide_layout ? "wide" : "narrow"},
          {"geometry", c.image_geometry ? "image" : "buffer"},
          {"packets", c.packets},
          {"packet_group", c.packet_group},
          {"group", c.group},
          {"render_group", {c.render_group_width, c.render_group_height}},
          {"trace_registers", c.trace_registers},
          {"leaf_sure", c.leaf_sure},
          {"leaf_size", c.leaf_size}};
}

json to_json(const tuning_settings& s) {
  return {{"quick", s.is_quick}, {"only", s.only},
          {"rounds", s.rounds},  {"repeats", s.repeats},
          {"margin", s.margin},  {"hopeless", s.hopeless},
          {"seed", s.seed},      {"bootstrap", {{"resamples", s.resamples}, {"level", s.level}}}};
}

json to_json(const workload_facts& w) {
  json j{{"name", w.name},
         {"scene", {{"name", w.scene_name}, {"hash", w.scene_hash}, {"triangles", w.triangles}}}};
  if (w.rays > 0)
    j["rays"] = w.rays;
  else
    j["picture"] = {{"width", w.width}, {"height", w.height}, {"max_depth", w.max_depth}};
  return j;
}

json to_json(const relative_time& t) {
  if (t.rounds.empty()) return nullptr;
  return {{"rounds", t.rounds.size()},
          {"median", rounded(t.median)},
          {"interval", {rounded(t.range.low), rounded(t.range.high)}}};
}

json to_json(const trial& t, bool is_kept) {
  const char* standing = !t.refused.empty() ? "refused" : is_kept ? "kept so far" : "tried";
  json j{{"value", t.value}, {"standing", standing}};
  if (!t.refused.empty()) {
    j["reason"] = t.refused;
    return j;
  }
  j["warm_up_ms"] = rounded(t.warm_up_ms);
  j["median_ms"] = json::array();
  for (const std::vector<double>& ms : t.ms)
    j["median_ms"].push_back(rounded(summarize(ms).median));
  j["relative_time"] = to_json(t.relative);
  return j;
}

json to_json(const choice_result& c, const std::vector<workload_facts>& workloads) {
  json j{{"name", c.name}, {"taken", c.trials[c.taken].value}};
  j["workloads"] = json::array();
  for (const std::uint32_t w : c.workloads) j["workloads"].push_back(workloads[w].name);
  j["trials"] = json::array();
  for (std::size_t k = 0; k < c.trials.size(); ++k)
    j["trials"].push_back(to_json(c.trials[k], k == 0));
  if (c.challenger)
    j["confirmation"] = {{"value", c.trials[*c.challenger].value},
                         {"relative_time", to_json(c.confirmation)}};
  else
    j["confirmation"] = nullptr;
  return j;
}

json entry_of(const tuning_result& r) {
  json j{{"device", to_json(tuned_device_of(*r.from.device))},
         {"date", r.from.date},
         {"facet", {{"version", r.from.version}, {"commit", r.from.commit}}},
         {"cpu", r.from.cpu},
         {"values", to_json(r.values)},
         {"settings", to_json(r.settings)}};
  j["workloads"] = json::array();
  for (const workload_facts& w : r.workloads) j["workloads"].push_back(to_json(w));
  j["choices"] = json::array();
  for (const choice_result& c : r.choices) j["choices"].push_back(to_json(c, r.workloads));
  return j;
}

json table(json devices) {
  return {{"format", tuning_format}, {"version", tuning_version}, {"devices", std::move(devices)}};
}

/// The entries at `path` that `keeps` says true of.
template <class Test>
json entries_at(const std::filesystem::path& path, const Test& keeps) {
  json kept = json::array();
  const tuning_table whole = read_tuning_table(path);  // or an error that says where it is not
  if (whole.entries.empty()) return kept;
  const json file = json::parse(read_whole_file(path));
  for (std::size_t k = 0; k < whole.entries.size(); ++k)
    if (keeps(whole.entries[k].of)) kept.push_back(file["devices"][k]);
  return kept;
}

}  // namespace

std::string table_of(const tuning_result& r) {
  return json_text(table(json::array({entry_of(r)})));
}

std::string table_with(const std::filesystem::path& path, const tuning_result& r) {
  const tuned_device of = tuned_device_of(*r.from.device);
  json entries = entries_at(path, [&](const tuned_device& d) { return !(d == of); });
  entries.push_back(entry_of(r));
  return json_text(table(std::move(entries)));
}

std::string table_without(const std::filesystem::path& path, const tuned_device& d) {
  return json_text(
      table(entries_at(path, [&](const tuned_device& e) { return !e.is_same_but_for_driver(d); })));
}

}  // namespace facet::study
