#include "cli/variants_table.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

namespace facet::cli {
namespace {

std::string text(const char* format, double value) {
  char s[32];
  std::snprintf(s, sizeof s, format, value);
  return s;
}

/// "-" before anything was timed.
std::string rate(double value) { return value > 0 ? text("%.2f", value) : "-"; }

/// Both sets of rays together.
double rays_rate(const study::variant_result& v) {
  double rays = 0, ms = 0;
  for (const study::traced_rays& t : v.hits) {
    if (t.errors.rays == 0) continue;
    if (t.kernel.ms.empty()) return 0;
    rays += double(t.errors.rays), ms += t.kernel.values.median;
  }
  return ms > 0 ? rays / ms * 1e-3 : 0;
}

void print_line(const study::variant_result& v) {
  using study::hit_errors;
  if (v.state == study::variant_state::refused) {
    std::printf("%-26s refused: %s\n", v.of.name.c_str(), v.reason.c_str());
    return;
  }
  if (!v.is_judged) return;
  const study::times& t = v.picture;
  const std::string ms = t.ms.empty() ? "-" : text("%.3f", t.values.median),
                    range = t.ms.empty() ? ""
                                         : "[" + text("%.3f", t.range.low) + ", " +
                                               text("%.3f", t.range.high) + "]";
  const study::picture_errors& p = v.picture_error;
  std::printf(
      "%-26s %10s %-20s %8s %8s %8.0f %7.0f %7.0f %7.0f %5llu %9.2e %9.2e %7llu %7llu %9.2e\n",
      v.of.name.c_str(), ms.c_str(), range.c_str(), rate(v.mrays_per_s()).c_str(),
      rate(rays_rate(v)).c_str(), v.wrong_per_million(), v.per_million(&hit_errors::ties),
      v.per_million(&hit_errors::silhouettes), v.per_million(&hit_errors::errors),
      static_cast<unsigned long long>(
          std::max(v.hits[0].errors.p99_ulps, v.hits[1].errors.p99_ulps)),
      p.all.rmse, p.rest.rmse, static_cast<unsigned long long>(p.all.pixels_off_displayed),
      static_cast<unsigned long long>(p.off_displayed_explained), p.flip_mean);
}

}  // namespace

void print_table(const study::variants_result& r) {
  std::printf(
      "%s, %llu triangles, %ux%u, %u x %u samples a pixel, depth %u; %llu eye and %llu bounce "
      "rays\n",
      r.scene_name.c_str(), static_cast<unsigned long long>(r.triangles), r.settings.width,
      r.settings.height, r.samples, r.samples, r.max_depth,
      static_cast<unsigned long long>(r.variants[0].hits[0].errors.rays),
      static_cast<unsigned long long>(r.variants[0].hits[1].errors.rays));
  std::printf("%-26s %10s %-20s %8s %8s %8s %7s %7s %7s %5s %9s %9s %7s %7s %9s\n", "variant",
              "picture ms", "95% interval", "Mrays/s", "traced", "wrong", "ties", "silh.", "errors",
              "ulps", "RMSE", "no silh.", "off", "silh.", "FLIP");
  for (const study::variant_result& v : r.variants) print_line(v);
  std::printf(
      "Against the double reference. Mrays/s: of the picture's own rays; traced: eye and bounce "
      "rays\n"
      "alone. Wrong hits per million rays, of these ties, silhouettes and errors; p99 of t in "
      "ulps.\n"
      "RMSE of linear values, of all pixels and without silhouettes; pixels that a screen shows "
      "more\n"
      "than 1/255 off, of these silhouettes; mean FLIP.\n");
  std::fflush(stdout);
}

}  // namespace facet::cli
