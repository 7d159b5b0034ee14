// facet compare: how far two pictures lie apart.
#include "image/compare.hpp"

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/command.hpp"
#include "cli/options.hpp"
#include "cli/picture_file.hpp"
#include "cli/stats_file.hpp"
#include "image/output.hpp"
#include "scene/error.hpp"

namespace facet::cli {
namespace {

struct arguments {
  std::string a, b, json, transfer;
};

nlohmann::ordered_json to_json(const arguments& o, const image::difference& d) {
  return {{"a", o.a},
          {"b", o.b},
          {"width", d.width},
          {"height", d.height},
          {"max", d.max},
          {"mean", d.mean},
          {"rmse", d.rmse},
          // JSON has no infinity: null stands for equal pictures.
          {"psnr_db", std::isfinite(d.psnr) ? nlohmann::ordered_json(d.psnr) : nullptr},
          {"alpha_max", d.alpha_max},
          {"pixels_off", d.pixels_off},
          {"share_off", d.share_off()},
          {"pixels_off_displayed", d.pixels_off_displayed},
          {"share_off_displayed", d.share_off_displayed()},
          {"nan_pixels", d.nan_pixels},
          {"worst", {d.worst_x, d.worst_y}}};
}

void print(const image::difference& d) {
  std::printf("size                 %ux%u\n", d.width, d.height);
  std::printf("max error            %.9g at (%u, %u)\n", d.max, d.worst_x, d.worst_y);
  std::printf("mean error           %.9g\n", d.mean);
  std::printf("RMSE                 %.9g\n", d.rmse);
  std::printf("PSNR                 %.2f dB\n", d.psnr);
  std::printf("max alpha error      %.9g\n", d.alpha_max);
  std::printf("off by more than 1/255\n");
  std::printf("  linear             %llu pixels (%.4f%%)\n",
              static_cast<unsigned long long>(d.pixels_off), 100 * d.share_off());
  std::printf("  displayed (sRGB)   %llu pixels (%.4f%%)\n",
              static_cast<unsigned long long>(d.pixels_off_displayed),
              100 * d.share_off_displayed());
  if (d.nan_pixels)
    std::printf("NaN                  %llu pixels\n",
                static_cast<unsigned long long>(d.nan_pixels));
}

int run(const arguments& o) {
  std::optional<image::transfer> curve;
  if (o.transfer == "srgb") curve = image::transfer::srgb;
  if (o.transfer == "linear") curve = image::transfer::linear;
  if (!o.json.empty()) image::check_output(o.json);
  const picture a = read_picture_file(o.a, curve), b = read_picture_file(o.b, curve);
  if (a.width != b.width || a.height != b.height)
    throw scene_error(o.b, "",
                      "is " + std::to_string(b.width) + "x" + std::to_string(b.height) + ", but " +
                          o.a + " is " + std::to_string(a.width) + "x" + std::to_string(a.height) +
                          "; only pictures of one size can be compared");
  const image::difference d = image::compare(a, b);
  print(d);
  if (!o.json.empty()) write_json(o.json, to_json(o, d));
  return d.nan_pixels ? nan : done;
}

}  // namespace

command add_compare(CLI::App& program) {
  auto* app = program.add_subcommand("compare", "How far two pictures lie apart");
  auto o = std::make_shared<arguments>();
  app->add_option("A", o->a, "A picture: .npy of shape (height, width, 4), .png, .exr, ...")
      ->required();
  app->add_option("B", o->b, "A picture of the same size")->required();
  app->add_option("--json", o->json, "Write the figures to this file, too")->type_name("FILE");
  app->add_option("--transfer", o->transfer,
                  "How files of 8 or 16 bits become linear (default: what the file says, or sRGB)")
      ->check(CLI::IsMember({"srgb", "linear"}));
  app->footer(
      "Both pictures are made linear and clamped to [0, 1]. Errors are over the channels R, G and\n"
      "B; \"off\" looks at alpha, too. Exit code 0 however far apart they are, 3 if their sizes\n"
      "differ or one cannot be read, 7 if one holds NaN.");
  return {app, [o] { return run(*o); }};
}

}  // namespace facet::cli
