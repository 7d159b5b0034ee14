// The scene files that come with Facet.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/load.hpp"
#include "scene/schema_helper.hpp"
#include "scene/world_bounds.hpp"

using facet::box3d;
using facet::scene;

namespace {

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(FACET_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".json" && entry.path().stem().extension() != ".schema")
      files.push_back(entry.path());
  return files;
}

scene load(const char* name) {
  return facet::load_scene(std::filesystem::path(FACET_SOURCE_DIR "/scenes") / name);
}

bool is_transparent(const scene& s, const facet::instance& placed) {
  if (placed.material != facet::instance::own_materials)
    return s.materials[placed.material].is_transparent();
  const facet::mesh& m = s.meshes[placed.mesh];
  for (std::size_t i = 0; i < m.triangle_count(); ++i)
    if (s.materials[m.material_of(i)].is_transparent()) return true;
  return false;
}

bool overlap(const box3d& a, const box3d& b) {
  for (int i = 0; i < 3; ++i)
    if (a.hi[i] < b.lo[i] || b.hi[i] < a.lo[i]) return false;
  return true;
}

bool within(const box3d& inner, const box3d& outer) {
  for (int i = 0; i < 3; ++i)
    if (!(outer.lo[i] < inner.lo[i] && inner.hi[i] < outer.hi[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("every scene loads without a note, and the schema accepts it") {
  const auto files = scene_files();
  CHECK(files.size() >= 5);
  for (const auto& file : files) {
    CAPTURE(file.string());
    const scene s = facet::load_scene(file);
    CHECK(s.notes.empty());
    CHECK(!s.instances.empty());
    CHECK(!s.lights.empty());
    const auto value = nlohmann::json::parse(std::ifstream(file));
    CHECK(facet::test::schema_fault(value, facet::test::scene_schema()) == "");
    CHECK(value.value("$schema", "") == "facet-scene.schema.json");
  }
}

TEST_CASE(
    "transparent objects touch no other: boxes are apart, in a room or, nested, in one another") {
  for (const auto& file : scene_files()) {
    const scene s = facet::load_scene(file);
    std::vector<box3d> boxes;
    for (const auto& placed : s.instances)
      boxes.push_back(facet::world_box<double>(placed, s.meshes[placed.mesh]));
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (!is_transparent(s, s.instances[i])) continue;
      for (std::size_t j = 0; j < boxes.size(); ++j) {
        const bool in_room = s.meshes[s.instances[j].mesh].name == "room";
        CAPTURE(file.string());
        CAPTURE(i);
        CAPTURE(j);
        const bool is_nested =
            s.nesting > 1 && (within(boxes[i], boxes[j]) || within(boxes[j], boxes[i]));
        CHECK((i == j || is_nested ||
               (in_room ? within(boxes[i], boxes[j]) : !overlap(boxes[i], boxes[j]))));
      }
    }
  }
}

TEST_CASE("the showcase uses what a picture may hold") {
  const scene s = load("showcase.json");
  bool flat = false, smooth = false, many = false;
  std::vector<int> uses(s.meshes.size());
  for (const auto& placed : s.instances) many |= ++uses[placed.mesh] >= 3;
  for (const auto& m : s.meshes) (m.is_smooth() ? smooth : flat) = true;
  CHECK(flat);
  CHECK(smooth);
  CHECK(many);
  REQUIRE(s.lights.size() == 2);
  CHECK(s.lights[0].type != s.lights[1].type);
  bool glass = false, tinted = false, mirror = false;
  for (const auto& m : s.materials) {
    glass |= m.is_transparent() && !m.has_attenuation && m.Ni > 1;
    tinted |= m.is_transparent() && m.has_attenuation;
    mirror |= m.is_mirror() && !m.is_transparent();
  }
  CHECK(glass);
  CHECK(tinted);
  CHECK(mirror);
}

TEST_CASE("the terrain has its million triangles, the room its five walls") {
  CHECK(load("terrain.json").triangle_count() == 2 * 708 * 708);
  const scene room = load("room.json");
  std::vector<std::string> walls;
  for (std::size_t i = 0; i < 10; i += 2)
    for (const auto& m : room.meshes)
      if (m.name == "room") walls.push_back(room.materials[m.material_of(i)].name);
  CHECK(walls == std::vector<std::string>{"white", "white", "white", "red", "green"});
}
