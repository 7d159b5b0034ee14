#include "bench/result_file.hpp"

#include <nlohmann/json.hpp>

#include "image/output.hpp"
#include "study/json_text.hpp"
#include "study/result_json.hpp"

namespace facet::bench {

origin origin_now() { return {study::date(), study::cpu_name(), std::nullopt}; }

origin origin_now(const runtime::device& d) {
  origin from = origin_now();
  from.device = study::facts_of(d);
  return from;
}

nlohmann::ordered_json head_of(const std::string& format, const origin& from, int version) {
  nlohmann::ordered_json j{{"format", format},
                           {"version", version},
                           {"date", from.date},
                           {"facet", {{"version", study::version()}, {"commit", study::commit()}}}};
  j["device"] = nullptr;
  if (from.device) j["device"] = study::to_json(*from.device);
  j["cpu"] = from.cpu;
  return j;
}

nlohmann::ordered_json peer_of(const std::string& name, unsigned threads) {
  if (name.empty()) return nullptr;
  return {{"name", name}, {"threads", threads}};
}

void write_result(const std::string& path, const nlohmann::ordered_json& content) {
  image::write_file(path, study::json_text(content));
}

}  // namespace facet::bench
