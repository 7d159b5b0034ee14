#include "scene/load.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "scene/scratch_folder.hpp"
#include "scene/validate.hpp"

using facet::load_scene;
using facet::scene;
using facet::test::contains;
using facet::test::error_of;
using facet::test::scratch_folder;

namespace {

const char* const obj = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";
const char* const ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n2 0 0\n0 2 0\n3 0 1 2\n";
const char* const json = R"({"meshes": {"b": {"generate": "box"}}, "instances": [{"mesh": "b"}]})";

bool says(const scene& s, const std::string& part) {
  return std::any_of(s.notes.begin(), s.notes.end(),
                     [&](const std::string& note) { return note.find(part) != std::string::npos; });
}

}  // namespace

TEST_CASE("the extension chooses the reader, whatever its case") {
  const scratch_folder folder;
  for (const char* name : {"a.obj", "b.OBJ"})
    CHECK(load_scene(folder.write(name, obj)).triangle_count() == 1);
  for (const char* name : {"c.ply", "d.Ply"})
    CHECK(load_scene(folder.write(name, ply)).triangle_count() == 1);
  for (const char* name : {"e.json", "f.JSON"})
    CHECK(load_scene(folder.write(name, json)).triangle_count() == 12);
}

TEST_CASE("another extension is told which ones there are") {
  for (const char* name : {"scene.stl", "scene", "scene.json.txt"}) {
    const auto e = error_of([&] { load_scene(name); });
    CHECK(e.file() == name);
    CHECK(contains(e.what(), ".json"));
    CHECK(contains(e.what(), ".obj"));
    CHECK(contains(e.what(), ".ply"));
  }
  CHECK_THROWS_AS(facet::read_mesh_file("scene.json"), facet::scene_error);
}

TEST_CASE("a missing file is an error that names it, for each reader") {
  const scratch_folder folder;
  for (const char* name : {"none.json", "none.obj", "none.ply"})
    CHECK(contains(error_of([&] { load_scene(folder.path() / name); }).what(), name));
}

TEST_CASE("a mesh alone is a scene, and all that was made up is said") {
  const scratch_folder folder;
  const scene s = load_scene(folder.write("alone.obj", obj));
  CHECK(s.name == "alone");
  CHECK(s.meshes[0].name == "alone");
  CHECK(s.instances.size() == 1);
  CHECK(s.instances[0].world_from_object.is_identity());
  CHECK(s.lights.size() == 1);
  CHECK(s.ambient.x > 0);
  CHECK(s.view.look_at == facet::vec3d(1, 1, 0));
  REQUIRE(s.materials.size() == 1);
  CHECK(s.materials[0].Ka.x > 0);
  for (const char* part : {"camera", "y up", "light", "ambient", "background", "material"}) {
    CAPTURE(part);
    CHECK(says(s, part));
  }
}

TEST_CASE("a mesh that brings materials keeps them") {
  facet::mesh_file file;
  file.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.mesh.indices = {0, 1, 2};
  file.materials.resize(2);
  file.materials[1].name = "gold";
  file.mesh.materials = {1};
  file.notes = {"from the reader"};
  const scene s = facet::scene_of_mesh(file, "coin");
  CHECK(s.materials.size() == 2);
  CHECK(s.materials[s.meshes[0].material_of(0)].name == "gold");
  CHECK(says(s, "from the reader"));
  CHECK(!says(s, "no material"));
  CHECK_NOTHROW(facet::validate(s, "coin"));
}

TEST_CASE("a mesh that lies in one point is framed all the same") {
  facet::mesh_file file;
  file.mesh.positions = {{3, 3, 3}};
  file.mesh.indices = {0, 0, 0};
  CHECK_NOTHROW(facet::validate(facet::scene_of_mesh(file, "point"), ""));
}
