#include "bench/result_file.hpp"

#include <nlohmann/json.hpp>

#include "image/output.hpp"
#include "study/json_text.hpp"
#include "study/result_json.hpp"

namespace facet::bench {

nlohmann::ordered_json head_of(const std::string& format, const study::origin& from, int version) {
  nlohmann::ordered_json j{{"format", format}, {"version", version}};
  j.update(study::to_json(from));
  return j;
}

nlohmann::ordered_json peer_of(const std::string& name, unsigned threads) {
  if (name.empty()) return nullptr;
  return {{"name", name}, {"threads", threads}};
}

std::string name_of(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

void write_result(const std::string& path, const nlohmann::ordered_json& content) {
  image::write_file(path, study::json_text(content));
}

}  // namespace facet::bench
