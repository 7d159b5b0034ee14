#include "study/sweep_json.hpp"

#include <nlohmann/json.hpp>

#include "study/json_text.hpp"
#include "study/result_json.hpp"

namespace facet::study {
namespace {

using json = nlohmann::ordered_json;

const char* word_of(standing s) {
  switch (s) {
    case standing::measured:
      return "measured";
    case standing::refused:
      return "refused";
    case standing::different:
      return "different";
    case standing::unfinished:
      break;
  }
  return "unfinished";
}

const char* word_of(tracer::geometry_kind g) {
  switch (g) {
    case tracer::geometry_kind::buffer:
      return "buffer";
    case tracer::geometry_kind::image:
      return "image";
    case tracer::geometry_kind::automatic:
      break;
  }
  return "auto";
}

json to_json(const speed_up& s) {
  if (s.value == 0) return nullptr;
  return {{"value", s.value}, {"interval", to_json(s.range)}};
}

json to_json(const shape_result& s) {
  json j{{"shape", s.of.text()}, {"standing", word_of(s.state)}};
  if (!s.reason.empty()) j["reason"] = s.reason;
  if (s.differs) {
    j["differing_pixels"] = s.differs;
    j["first_differing_pixel"] = {s.differs_x, s.differs_y};
  }
  if (s.state == standing::refused) return j;
  j["warm_up_ms"] = s.warm_up_ms;
  j["kernel"] = to_json(s.kernel);
  j["wall"] = to_json(s.wall);
  j["speed_up"] = {{"kernel", to_json(s.by_kernel)}, {"wall", to_json(s.by_wall)}};
  return j;
}

json to_json(const experiment_result& e) {
  const auto names = [&](const std::vector<std::uint32_t>& indices) {
    json list = json::array();
    for (const std::uint32_t i : indices)
      list.push_back(i == e.shapes.size() ? "serial" : e.shapes[i].of.text());
    return list;
  };
  json shapes = json::array();
  for (const shape_result& s : e.shapes) shapes.push_back(to_json(s));
  json serial{{"build_ms", e.serial.build_ms}, {"wall", to_json(e.serial.wall)}};
  serial["pixels_off"] = e.serial.pixels_off;
  return {{"name", e.name},
          {"complete", e.complete},
          {"scene",
           {{"name", e.scene_name},
            {"hash", e.scene_hash},
            {"triangles", e.triangles},
            {"instances", e.instances}}},
          {"picture",
           {{"width", e.width},
            {"height", e.height},
            {"max_depth", e.max_depth},
            {"samples", e.samples}}},
          {"tree", {{"kind", e.tree}, {"depth", e.tree_depth}, {"nodes", e.tree_nodes}}},
          {"kernel",
           {{"hash", e.kernel_hash},
            {"text_hash", e.text_hash},
            {"options", e.options},
            {"features", e.features},
            {"geometry", e.geometry},
            {"largest_group", e.group_items}}},
          {"device_bytes", e.device_bytes},
          {"compile_ms", e.compile_ms},
          {"upload_ms", e.upload_ms},
          {"build_ms", e.build_ms},
          {"serial", std::move(serial)},
          {"best", names(e.best)},
          {"shapes", std::move(shapes)},
          {"order", names(e.order)}};
}

json to_json(const sweep_settings& s) {
  json shapes = json::array();
  for (const shape& one : s.shapes) shapes.push_back(one.text());
  return {{"repeats", s.repeats},
          {"serial_repeats", s.serial_repeats},
          {"warm_ups", 1},
          {"seed", s.seed},
          {"bootstrap", {{"resamples", s.resamples}, {"level", s.level}}},
          {"geometry", word_of(s.tracer.geometry)},
          {"all_features", s.tracer.all_features},
          {"tile", {s.tracer.tile_width, s.tracer.tile_height}},
          {"kernels", s.tracer.kernel_folder.empty() ? "embedded" : "folder"},
          {"shapes", std::move(shapes)}};
}

}  // namespace

std::string to_json(const sweep_result& r) {
  json experiments = json::array(), left_out = json::array();
  for (const experiment_result& e : r.experiments) experiments.push_back(to_json(e));
  for (const omission& o : r.left_out)
    left_out.push_back({{"experiment", o.experiment}, {"reason", o.reason}});
  json file{{"format", "facet-sweep"}, {"version", 1}, {"complete", r.complete}};
  file.update(to_json(r.from));
  file["settings"] = to_json(r.settings);
  file["experiments"] = std::move(experiments);
  file["left_out"] = std::move(left_out);
  return json_text(file);
}

}  // namespace facet::study
