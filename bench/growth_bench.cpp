// Row `growth`: time against triangles, with a tree, without one, and by the serial reference.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/growth.hpp"
#include "bench/rows.hpp"
#include "image/output.hpp"
#include "runtime/runtime.hpp"

namespace facet::bench {
namespace {

constexpr double least_triangles = 2, most_triangles = 1 << 27;

struct arguments {
  growth_settings settings;
  std::vector<double> triangles;
  double most = 1e6;
  std::string device = "0", json;
};

/// 1 and 3 times each power of ten, up to `most`.
std::vector<std::uint64_t> decades(double most) {
  std::vector<std::uint64_t> sizes;
  for (std::uint64_t power = 100; double(power) <= most; power *= 10)
    for (const std::uint64_t n : {power, 3 * power})
      if (double(n) <= most) sizes.push_back(n);
  return sizes;
}

/// Those of `from`, smallest first. Throws CLI::ValidationError.
std::vector<std::uint64_t> whole(std::vector<double> from) {
  std::sort(from.begin(), from.end());
  std::vector<std::uint64_t> sizes;
  for (const double n : from) {
    if (n != std::floor(n) || n < least_triangles || n > most_triangles) {
      char text[120];
      std::snprintf(text, sizeof text, "found %g; allowed are whole numbers from %g to %.0f", n,
                    least_triangles, most_triangles);
      throw CLI::ValidationError("--triangles", text);
    }
    if (sizes.empty() || sizes.back() != std::uint64_t(n)) sizes.push_back(std::uint64_t(n));
  }
  return sizes;
}

void print(const growth_series& s, std::uint64_t asked) {
  if (s.ended && s.ended->triangles == asked)
    std::printf("%31s  ends before %llu triangles: %s\n", word_of(s.by),
                static_cast<unsigned long long>(asked), s.ended->reason.c_str());
  if (s.ended || s.points.empty()) return;
  const growth_point& p = s.points.back();
  std::printf("%-16s %9llu %-7s %10.2f", p.mesh.c_str(),
              static_cast<unsigned long long>(p.triangles), word_of(s.by), p.build.values.median);
  for (const growth_figure& f : p.figures) {
    const auto rate = [&](double ms) { return double(f.count) / ms * 1e-3; };
    std::printf("   %.3f (%.3f-%.3f)", rate(f.time.values.median), rate(f.time.range.high),
                rate(f.time.range.low));
  }
  std::printf("\n");
}

void run(const arguments& o) {
  growth_settings s = o.settings;
  s.triangles = o.triangles.empty() ? decades(o.most) : whole(o.triangles);
  if (s.width % 64 != 0)
    throw CLI::ValidationError("--width", "found " + std::to_string(s.width) +
                                              "; allowed are multiples of 64: the picture is 16:9 "
                                              "in tiles of 8 x 4");
  s.height = s.width / 16 * 9;
  if (!o.json.empty()) image::check_output(o.json);
  const runtime::queue queue(runtime::select_device(o.device));
  std::printf(
      "%dx%d eye rays, and the shadow and bounce rays of their hits, on %s\n"
      "%-16s %9s %-7s %10s   Mrays/s: median (95%% interval) of eye, shadow, bounce\n",
      s.width, s.height, queue.get_device().name().c_str(), "mesh", "triangles", "way",
      "build, ms");
  std::size_t size = 0;
  const growth_result r = measure_growth(queue, s, [&](const growth_result& so_far) {
    for (const growth_series& series : so_far.families.back().series)
      print(series, s.triangles[size]);
    std::fflush(stdout);
    size = (size + 1) % s.triangles.size();
    if (!o.json.empty()) write_result(o.json, to_json(so_far));
  });
  if (!o.json.empty()) write_result(o.json, to_json(r));
  if (const std::uint64_t differ = r.differing_hits())
    throw std::runtime_error(std::to_string(differ) +
                             " hits without the tree, or of the serial reference, differ from "
                             "those with it");
}

}  // namespace

void add_growth_row(CLI::App& app) {
  auto o = std::make_shared<arguments>();
  growth_settings& s = o->settings;
  CLI::App* row = app.add_subcommand(
      "growth", "Time against triangles: with a tree, without, and by the serial reference");
  row->add_option("--mesh", s.families, "families: terrain, soup")
      ->check(CLI::IsMember({"terrain", "soup"}))
      ->capture_default_str();
  auto* triangles = row->add_option("--triangles", o->triangles, "sizes, such as 1e3 1e4 1e8");
  row->add_option("--most", o->most, "sizes are 1 and 3 times powers of ten, from 100 up to this")
      ->excludes(triangles)
      ->check(CLI::Range(100.0, most_triangles))
      ->capture_default_str();
  row->add_option("--width", s.width, "of the picture that eye rays are of, pixels; it is 16:9")
      ->check(CLI::Range(64, 7680))
      ->capture_default_str();
  row->add_option("--repeat", s.repeats, "timed passes of each figure, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--builds", s.builds, "timed builds of the tree, after one to warm up")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  row->add_option("--budget", s.budget_s,
                  "seconds; a figure without a tree, or of the serial reference, that would take "
                  "longer ends its series")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  row->add_option("--geometry", s.geometry)
      ->check(CLI::IsMember({"auto", "image", "buffer"}))
      ->capture_default_str();
  row->add_option("--seed", s.drawing.seed, "of the intervals")->capture_default_str();
  row->add_option("--device", o->device, "index, or part of a name")->capture_default_str();
  row->add_option("--json", o->json, "write what was found to this file, after each size");
  row->callback([o] { run(*o); });
}

}  // namespace facet::bench
