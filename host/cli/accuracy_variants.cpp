#include "cli/accuracy_variants.hpp"

#include <algorithm>
#include <thread>

#include "cli/command.hpp"
#include "cli/device_choice.hpp"
#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/mesh_word.hpp"
#include "cli/picture_size.hpp"
#include "cli/progress.hpp"
#include "cli/variants_table.hpp"
#include "image/output.hpp"
#include "scene/nearest.hpp"
#include "scene/placed.hpp"
#include "study/variant_json.hpp"
#include "study/variant_run.hpp"

namespace facet::cli {
namespace {

/// Eye rays of the picture (its width times the side of its grid of samples is given), and of a
/// picture without a tree times triangles.
struct budget {
  std::uint32_t rays_wide;
  double brute_tests;
};
constexpr budget gpu_budget{1280, 2e10}, other_budget{320, 3e7};

using variants = std::vector<study::listed_variant>;

[[noreturn]] void unknown_variant(const std::string& name, const variants& all) {
  std::vector<std::string> known;
  for (const study::listed_variant& v : all) known.push_back(v.name);
  throw usage_error("--only: " + unknown_name("variant", name, known) +
                    ". Depths are those below the scene's");
}

/// Those named, in the list's order; the first is strict.
variants chosen(const variants_request& r, const variants& all) {
  if (!r.only) return all;
  const auto& names = *r.only;
  for (const std::string& name : names)
    if (std::none_of(all.begin(), all.end(), [&](const auto& v) { return v.name == name; }))
      unknown_variant(name, all);
  variants some;
  for (const study::listed_variant& v : all)
    if (v.name == all[0].name || std::find(names.begin(), names.end(), v.name) != names.end())
      some.push_back(v);
  return some;
}

/// Takes out what would need too many tests of triangles, unless it was asked for by name.
std::vector<study::omitted_variant> leave_out(variants& v, const variants_request& r,
                                              const scene& s, std::uint64_t eye_rays,
                                              const budget& b, const console& say) {
  std::vector<study::omitted_variant> left_out;
  const double tests = double(eye_rays) * double(s.placed_triangle_count());
  if (r.only || tests <= b.brute_tests) return left_out;
  std::erase_if(v, [&](const study::listed_variant& one) {
    if (one.options.tree != tracer::tree_kind::none) return false;
    left_out.push_back({one.name, std::to_string(s.placed_triangle_count()) +
                                      " triangles are too many to test each of them for each of " +
                                      std::to_string(eye_rays) + " eye rays"});
    say.say("note: the variant " + one.name + " is left out: " + left_out.back().reason +
            " (--only " + one.name + " runs it)");
    return true;
  });
  return left_out;
}

study::variant_settings settings_of(const variants_request& r, const scene& s, const budget& b) {
  const size picture = r.picture.width ? r.picture
                                       : picture_size({std::max(1u, b.rays_wide / s.samples), 0},
                                                      {s.width, s.height});
  study::variant_settings o;
  o.width = picture.width, o.height = picture.height;
  o.repeats = r.repeats;
  o.seed = r.seed;
  o.threads = std::max(1u, std::thread::hardware_concurrency());
  return o;
}

}  // namespace

int run_accuracy_variants(const variants_request& r, const console& say) {
  if (!r.json.empty()) {
    if (image::same_file(r.json, r.scene))
      throw usage_error("--json would overwrite the scene, " + r.scene);
    image::check_output(r.json);
  }
  const scene s = placed(picture_of_word(r.scene));
  const variants all = study::variant_list(s.max_depth);
  variants list = chosen(r, all);
  const runtime::device device = choose_device(r.device, say);
  say.notes(s.notes);
  const budget& b = device.is_gpu() ? gpu_budget : other_budget;
  const study::variant_settings settings = settings_of(r, s, b);
  const std::uint64_t pixels = std::uint64_t(settings.width) * settings.height,
                      eye_rays = pixels * s.samples * s.samples;
  if (eye_rays > study::most_eye_rays)
    throw usage_error("--size: " + std::to_string(settings.width) + "x" +
                      std::to_string(settings.height) + " pixels have " + std::to_string(eye_rays) +
                      " eye rays; at most " + std::to_string(study::most_eye_rays) +
                      " are allowed");

  study::variants_result result;
  result.left_out = leave_out(list, r, s, eye_rays, b, say);
  // A picture for each variant; twice as rays, hits of the reference, and of two variants.
  require_memory(pixels * 16 * (list.size() + 2) + 2 * eye_rays * (32 + 32 + 2 * 20),
                 std::to_string(eye_rays) + " eye rays, as many bounce rays, and " +
                     std::to_string(list.size() + 2) + " pictures");
  stop_if_interrupted("reading the scene");

  const auto save = [&] {
    if (!r.json.empty() && result.has_findings()) image::write_file(r.json, study::to_json(result));
  };
  int percent = 0;
  try {
    progress_bar bar("measuring variants", say.quiet);
    study::run_variants(
        runtime::queue(device), s, list, settings, result,
        [&](std::uint64_t now, std::uint64_t total) {
          bar.update(now, total);
          percent = int(100 * now / std::max<std::uint64_t>(1, total));
        },
        &interrupt_flag());
  } catch (...) {
    save();
    throw;
  }
  save();
  if (result.has_findings()) print_table(result);
  if (!result.complete)
    throw interrupted_error("interrupted at " + std::to_string(percent) + "%; " +
                            (!result.has_findings() ? "nothing was measured yet"
                             : r.json.empty()
                                 ? "the table has what was found"
                                 : r.json + " holds what was found, marked as not complete"));
  if (!r.json.empty()) say.say("wrote " + r.json);
  const std::vector<std::string> broken = result.broken_promises();
  if (broken.empty()) return cli::done;
  std::string message = "variants that are promised to be exact are not:";
  for (const std::string& line : broken) message += "\n" + line;
  throw device_error(message);
}

}  // namespace facet::cli
