#include "study/provenance.hpp"

#include <algorithm>
#include <ctime>
#include <fstream>

namespace facet::study {
namespace {

const char* word_of(runtime::info::device_type type) {
  switch (type) {
    case runtime::info::device_type::cpu:
      return "cpu";
    case runtime::info::device_type::gpu:
      return "gpu";
    case runtime::info::device_type::accelerator:
      return "accelerator";
    case runtime::info::device_type::other:
      break;
  }
  return "other";
}

}  // namespace

device_facts facts_of(const runtime::device& d) {
  return {
      d.name(),          d.platform_name(),     d.driver_version(), d.version(),
      word_of(d.type()), d.max_compute_units(), d.max_clock_mhz(),  d.profiling_timer_resolution()};
}

std::string cpu_name() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.starts_with("model name"))
      return line.substr(std::min(line.find(": "), line.size() - 2) + 2);
  return "unknown";
}

std::string version() { return FACET_VERSION; }

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

origin origin_now() { return {date(), version(), commit(), cpu_name(), std::nullopt}; }

origin origin_now(const runtime::device& d) {
  origin from = origin_now();
  from.device = facts_of(d);
  return from;
}

}  // namespace facet::study
