#include "cli/sweep_table.hpp"

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace facet::cli {
namespace {

void print_line(const std::string& name, const study::times& t, const study::speed_up* ratio) {
  std::printf("  %-18s %11.4f ms  [%.4f, %.4f]", name.c_str(), t.values.median, t.range.low,
              t.range.high);
  if (ratio && ratio->value > 0)
    std::printf("  %8.2fx  [%.2f, %.2f]", ratio->value, ratio->range.low, ratio->range.high);
  std::printf("\n");
}

}  // namespace

void print_table(const study::experiment_result& e) {
  constexpr std::size_t most_listed = 5;
  std::printf("%s: %s, %llu triangles, tree %s, %ux%u\n", e.name.c_str(), e.scene_name.c_str(),
              static_cast<unsigned long long>(e.triangles), e.tree.c_str(), e.width, e.height);
  if (!e.serial.wall.ms.empty()) print_line("serial", e.serial.wall, nullptr);
  std::vector<const study::shape_result*> refused;
  std::size_t measured = 0;
  for (const study::shape_result& s : e.shapes) {
    if (s.state == study::standing::refused) refused.push_back(&s);
    if (s.state != study::standing::measured) continue;
    if (measured++ == 0 || s.of.is_driver()) print_line(s.of.text(), s.kernel, &s.by_kernel);
  }
  if (!e.best.empty())
    std::printf("  best: %zu of %zu shapes, whose intervals overlap\n", e.best.size(), measured);
  std::vector<std::uint32_t> best = e.best;
  std::sort(best.begin(), best.end(), [&](std::uint32_t a, std::uint32_t b) {
    return e.shapes[a].kernel.values.median < e.shapes[b].kernel.values.median;
  });
  for (std::size_t i = 0; i < std::min(best.size(), most_listed); ++i) {
    const study::shape_result& s = e.shapes[best[i]];
    print_line("  " + s.of.text(), s.kernel, &s.by_kernel);
  }
  if (!refused.empty())
    std::printf("  refused: %zu of %zu shapes; %s: %s\n", refused.size(), e.shapes.size(),
                refused[0]->of.text().c_str(), refused[0]->reason.c_str());
  std::fflush(stdout);
}

}  // namespace facet::cli
