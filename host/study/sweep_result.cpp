#include "study/sweep_result.hpp"

#include <algorithm>

namespace facet::study {
namespace {

speed_up ratio(const times& serial, const times& device, const resampling& r) {
  if (serial.ms.empty() || device.ms.empty() || !(device.values.least > 0)) return {};
  return {serial.values.median / device.values.median, ratio_interval(serial.ms, device.ms, r)};
}

}  // namespace

bool sweep_result::has_samples() const {
  return std::any_of(experiments.begin(), experiments.end(),
                     [](const experiment_result& e) { return !e.order.empty(); });
}

std::vector<std::string> sweep_result::differences() const {
  std::vector<std::string> lines;
  for (const experiment_result& e : experiments)
    for (const shape_result& s : e.shapes)
      if (s.state == standing::different)
        lines.push_back("experiment " + e.name + ", shape " + s.of.text() + ": " + s.reason);
  return lines;
}

void conclude(experiment_result& e, const sweep_settings& settings) {
  const resampling r{settings.resamples, settings.level, settings.seed};
  e.serial.wall.conclude(r);
  std::vector<std::uint32_t> measured;
  std::vector<estimate> estimates;
  for (std::uint32_t i = 0; i < e.shapes.size(); ++i) {
    shape_result& s = e.shapes[i];
    s.kernel.conclude(r);
    s.wall.conclude(r);
    if (s.state == standing::different) continue;
    s.by_kernel = ratio(e.serial.wall, s.kernel, r);
    s.by_wall = ratio(e.serial.wall, s.wall, r);
    if (s.state != standing::measured) continue;
    measured.push_back(i);
    estimates.push_back({s.kernel.values.median, s.kernel.range});
  }
  e.best.clear();
  if (e.complete)
    for (const std::size_t k : best_set(estimates)) e.best.push_back(measured[k]);
}

}  // namespace facet::study
