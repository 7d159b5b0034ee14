#include "study/result_json.hpp"

#include <nlohmann/json.hpp>

namespace facet::study {

using json = nlohmann::ordered_json;

json to_json(const interval& i) { return json::array({i.low, i.high}); }

json to_json(const times& t) {
  if (t.ms.empty()) return {{"samples_ms", json::array()}, {"summary", nullptr}};
  return {{"samples_ms", t.ms},
          {"summary",
           {{"median_ms", t.values.median},
            {"interval_ms", to_json(t.range)},
            {"mean_ms", t.values.mean},
            {"deviation_ms", t.values.deviation},
            {"least_ms", t.values.least},
            {"most_ms", t.values.most}}}};
}

static json to_json(const device_facts& d) {
  return {{"name", d.name},
          {"platform", d.platform},
          {"driver", d.driver},
          {"opencl", d.opencl},
          {"type", d.type},
          {"compute_units", d.compute_units},
          {"max_clock_mhz", d.max_clock_mhz},
          {"timer_ns", d.timer_ns}};
}

json to_json(const origin& from) {
  return {{"date", from.date},
          {"facet", {{"version", from.version}, {"commit", from.commit}}},
          {"device", from.device ? to_json(*from.device) : json(nullptr)},
          {"cpu", from.cpu}};
}

}  // namespace facet::study
