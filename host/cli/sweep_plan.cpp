#include "cli/sweep_plan.hpp"

#include <algorithm>

#include "cli/interrupt.hpp"
#include "cli/memory.hpp"
#include "cli/mesh_word.hpp"
#include "cli/picture_size.hpp"
#include "scene/framing.hpp"
#include "scene/placed.hpp"

namespace facet::cli {
namespace {

/// All three experiments, with all shapes, take 2 to 4 minutes on PoCL with two cores, and a GPU
/// has work for each of its threads.
struct budget {
  std::uint32_t width;        ///< pixels, of one sample each
  std::uint64_t brute_tests;  ///< eye rays times triangles
};
constexpr budget gpu_budget{1280, 250'000'000}, other_budget{256, 10'000'000};

/// Below, large work-groups have nothing to divide.
constexpr std::uint32_t least_brute_width = 64;

/// A view of the hills that leaves little sky.
constexpr camera hills_view{{0.46, 0.36, 0.66}, {-0.02, -0.02, 0}, {0, 1, 0}, 40};

bool wants(const sweep_request& r, const std::string& experiment) {
  return !r.only || std::find(r.only->begin(), r.only->end(), experiment) != r.only->end();
}

size brute_size(const sweep_request& r, const scene& s, size full, const budget& b) {
  if (r.brute_width) return picture_size({r.brute_width, 0}, full);
  const double each = double(s.samples) * s.samples * double(s.placed_triangle_count());
  size p = full;
  while (double(p.width) * p.height * each > double(b.brute_tests) && p.width > 1)
    p = {p.width / 2, std::max(1u, p.height / 2)};
  return p;
}

void add(sweep_plan& p, const sweep_request& r, const char* name, const scene& s,
         tracer::tree_kind tree, size of) {
  // The expected picture, the one under way, and the serial reference's.
  require_memory(std::uint64_t(of.width) * of.height * 4 * sizeof(float) * 3,
                 "three pictures of " + std::to_string(of.width) + "x" + std::to_string(of.height));
  p.experiments.push_back({name, &s, tree, of.width, of.height, r.max_depth.value_or(s.max_depth)});
}

void add_without_tree(sweep_plan& p, const sweep_request& r, size full, const budget& b,
                      const console& say) {
  const size reduced = brute_size(r, p.given, full, b);
  if (reduced.width >= std::min(least_brute_width, full.width) || r.brute_width)
    return add(p, r, "no-tree", p.given, tracer::tree_kind::none, reduced);
  const std::string reason = std::to_string(p.given.placed_triangle_count()) +
                             " triangles are too many to test each of them for each ray of a "
                             "picture";
  if (r.only)
    throw usage_error("--experiments no-tree: " + reason +
                      "; give the picture's size by --brute-width, or take a smaller scene");
  say.say("note: the experiment no-tree is left out: " + reason + " (--brute-width runs it)");
  p.left_out.push_back({"no-tree", reason});
}

scene larger_scene(const sweep_request& r, const console& say) {
  scene s = placed(picture_of_word(r.large.empty() ? "terrain:500" : r.large));
  if (!r.large.empty()) {
    say.notes(s.notes);
    return s;
  }
  s.view = hills_view;
  s.lights = {key_light_for(s.view)};
  return s;
}

}  // namespace

const std::vector<std::string>& sweep_experiments() {
  static const std::vector<std::string> names{"no-tree", "tree", "large"};
  return names;
}

std::unique_ptr<sweep_plan> plan_sweep(const sweep_request& r, bool on_gpu, const console& say) {
  auto p = std::make_unique<sweep_plan>();
  p->given = placed(picture_of_word(r.scene));
  say.notes(p->given.notes);
  const scene& s = p->given;
  const budget& b = on_gpu ? gpu_budget : other_budget;
  size asked = r.picture;
  if (!asked.width && !asked.height) asked.width = std::max(1u, b.width / s.samples);
  const size full = picture_size(asked, {s.width, s.height});
  if (wants(r, "no-tree")) add_without_tree(*p, r, full, b, say);
  if (wants(r, "tree")) add(*p, r, "tree", s, tracer::tree_kind::binned, full);
  if (wants(r, "large")) {
    p->large = larger_scene(r, say);
    add(*p, r, "large", p->large, tracer::tree_kind::binned, full);
  }
  stop_if_interrupted("reading the scenes");
  return p;
}

}  // namespace facet::cli
