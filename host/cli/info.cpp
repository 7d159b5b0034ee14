// facet info: what a scene holds and what it will take; or, with --tree, how good its trees are.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "cli/command.hpp"
#include "cli/console.hpp"
#include "cli/info_trees.hpp"
#include "cli/mesh_word.hpp"
#include "cli/options.hpp"
#include "image/output.hpp"
#include "scene/placed.hpp"
#include "scene/world_bounds.hpp"
#include "study/tree_makers.hpp"
#include "tracer/features.hpp"
#include "tracer/layout.hpp"

namespace facet::cli {
namespace {

constexpr std::size_t shown = 20;  // of each list

std::uint64_t host_bytes(const scene& s) {
  std::uint64_t bytes = 0;
  for (const mesh& m : s.meshes)
    bytes +=
        (m.positions.size() + m.normals.size()) * sizeof(vec3f) +
        4 * (m.indices.size() + m.normal_indices.size() + m.materials.size() + m.source.size());
  return bytes + s.instances.size() * sizeof(instance) + s.materials.size() * sizeof(material);
}

/// What stays on the device: a node and three corners a triangle, normals where any mesh has them.
std::uint64_t device_bytes(const scene& s) {
  const bool smooth = tracer::features::of(s).smooth;
  const std::uint64_t corners = 3 * 4 * sizeof(float);
  return s.triangle_count() *
             (sizeof(tracer::Node) + sizeof(tracer::TriangleInfo) + corners * (smooth ? 2 : 1)) +
         s.instances.size() * (sizeof(tracer::Node) + sizeof(tracer::Instance)) +
         s.materials.size() * sizeof(tracer::Material) + s.lights.size() * sizeof(tracer::Light);
}

std::string features_of(const scene& s, std::size_t index) {
  const material& m = s.materials[index];
  std::string words;
  const auto add = [&](bool on, const char* word) {
    if (on) words.append(words.empty() ? "" : ", ").append(word);
  };
  add(m.is_transparent(), "transparency");
  add(m.is_mirror(), "reflection");
  add(m.Ks.x > 0 || m.Ks.y > 0 || m.Ks.z > 0, "specular");
  add(m.Ke.x > 0 || m.Ke.y > 0 || m.Ke.z > 0, "emission");
  return words.empty() ? "diffuse alone" : words;
}

void print_rest(std::size_t count) {
  if (count > shown) std::printf("  ... and %zu more\n", count - shown);
}

void print(const scene& s) {
  const box3d box = world_box<double>(s);
  std::printf("scene       %s\n", s.name.c_str());
  std::printf("picture     %ux%u, depth %u, %u %s a pixel\n", s.width, s.height, s.max_depth,
              s.samples * s.samples, s.samples == 1 ? "sample" : "samples");
  std::printf("triangles   %zu in %zu %s\n", s.triangle_count(), s.meshes.size(),
              s.meshes.size() == 1 ? "mesh" : "meshes");
  std::printf("instances   %zu, which show %llu triangles\n", s.instances.size(),
              static_cast<unsigned long long>(s.placed_triangle_count()));
  std::printf("lights      %zu\n", s.lights.size());
  if (box.empty())
    std::printf("bounds      none: nothing is placed\n");
  else
    std::printf("bounds      (%g, %g, %g) to (%g, %g, %g)\n", box.lo.x, box.lo.y, box.lo.z,
                box.hi.x, box.hi.y, box.hi.z);
  const scene traced = placed(s);
  if (traced.around_camera)
    std::printf("traced      as one mesh of %zu triangles, which stand in the world\n",
                traced.triangle_count());
  std::printf("features    %s\n", tracer::features::of(traced).names().c_str());
  std::printf("memory      %s on the host, about %s on a device; a picture of %s\n",
              bytes_text(double(host_bytes(s))).c_str(),
              bytes_text(double(device_bytes(traced))).c_str(),
              bytes_text(16.0 * s.width * s.height).c_str());
  std::printf("meshes      %zu\n", s.meshes.size());
  for (std::size_t i = 0; i < s.meshes.size() && i < shown; ++i) {
    const mesh& m = s.meshes[i];
    std::printf("  %-16s %zu triangles, %s%s\n", m.name.c_str(), m.triangle_count(),
                m.is_smooth() ? "smooth" : "flat",
                m.dropped ? (", " + std::to_string(m.dropped) + " dropped").c_str() : "");
  }
  print_rest(s.meshes.size());
  std::printf("materials   %zu\n", s.materials.size());
  for (std::size_t i = 0; i < s.materials.size() && i < shown; ++i)
    std::printf("  %-16s %s\n", s.materials[i].name.c_str(), features_of(s, i).c_str());
  print_rest(s.materials.size());
  if (!s.notes.empty()) std::printf("notes\n");
  for (const std::string& note : s.notes) std::printf("  %s\n", note.c_str());
}

struct arguments {
  std::string scene;
  trees_request trees;
  console say;
};

/// Of all builders.
std::string words(const char* between) {
  std::string all;
  for (const study::tree_maker& m : study::tree_makers())
    all += (all.empty() ? "" : between) + m.word;
  return all;
}

CLI::Validator known_builder() {
  return CLI::Validator(
      [](std::string& text) -> std::string {
        if (study::tree_maker_of(text)) return "";
        return "found \"" + text + "\"; allowed: " + words(", ");
      },
      "", "known_builder");
}

}  // namespace

command add_info(CLI::App& program) {
  auto* app = program.add_subcommand("info", "What a scene holds and what it needs");
  auto o = std::make_shared<arguments>();
  app->add_option("SCENE", o->scene,
                  "A scene: .json; a mesh alone: .obj, .ply; or a generator, like torus_knot")
      ->required();
  app->add_option("--tree", o->trees.builders,
                  "In place of that: how good the trees of these builders are, by commas: " +
                      words(", ") + ".\nsah and sweep are made on the host")
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(known_builder());
  add_device(*app, o->trees.device, false);
  add_kernels(*app, o->trees.tracer);
  app->add_option("--samples", o->trees.samples,
                  "Triangles that overlap is measured of, where a mesh has more (default 10000)")
      ->type_name("N")
      ->check(whole_number(2, 1u << 30, "triangles"));
  app->add_option("--seed", o->trees.seed, "Of the samples (default 1)")
      ->type_name("N")
      ->check(whole_number(0, 0xffffffffu, ""));
  app->add_option("--json", o->trees.json,
                  "Write the figures to this file, as bench/facet-trees.schema.json has it")
      ->type_name("FILE");
  add_console(*app, o->say);
  return {
      app, [app, o] {
        if (app->count("--tree") == 0)
          for (const char* name : {"--device", "--geometry", "--layout", "--kernels",
                                   "--all-features", "--samples", "--seed", "--json"})
            if (app->count(name) > 0)
              throw usage_error(std::string(name) + " has no meaning without --tree " + words("|"));
        if (!o->trees.json.empty() && image::same_file(o->trees.json, o->scene))
          throw usage_error("--json would overwrite the scene, " + o->scene);
        const scene s = picture_of_word(o->scene);
        if (app->count("--tree") > 0)
          print_trees(s, o->trees, o->say);
        else
          print(s);
        return int(done);
      }};
}

}  // namespace facet::cli
