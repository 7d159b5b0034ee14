#include "scene/read_json_meshes.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scene/read_json.hpp"
#include "scene/scratch_folder.hpp"

using facet::scene;
using facet::test::contains;
using facet::test::error_of;
using facet::test::scratch_folder;

namespace {

const char* const triangle =
    "mtllib two.mtl\n"
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "usemtl first\nf 1 2 3\n"
    "usemtl second\nf 1 2 4\n";
const char* const two_materials = "newmtl first\nKd 0.1 0.1 0.1\nnewmtl second\nKd 0.2 0.2 0.2\n";

/// A scene in `folder` with the one mesh "m".
scene read_with(const scratch_folder& folder, const std::string& mesh,
                const std::string& materials = R"("a": {}, "b": {}, "c": {})") {
  return facet::read_json(folder.write(
      "scene.json", R"({"meshes": {"m": )" + mesh + R"(}, "materials": {)" + materials +
                        R"(}, "camera": {}, "instances": [{"mesh": "m"}]})"));
}
scene read_with(const std::string& mesh) { return read_with(scratch_folder(), mesh); }

std::vector<std::string> names_of_materials(const scene& s) {
  std::vector<std::string> names;
  const facet::mesh& m = s.meshes[0];
  for (std::size_t i = 0; i < m.triangle_count(); ++i)
    names.push_back(s.materials[m.material_of(i)].name);
  return names;
}

facet::scene_error fault(const scratch_folder& folder, const std::string& mesh) {
  return error_of([&] { read_with(folder, mesh); });
}
facet::scene_error fault(const std::string& mesh) { return fault(scratch_folder(), mesh); }

using names = std::vector<std::string>;

}  // namespace

TEST_CASE("a generated mesh takes its parameters, switches as 0 and 1 or as truth values") {
  CHECK(read_with(R"({"generate": "icosphere", "subdivisions": 2})").meshes[0].triangle_count() ==
        320);
  for (const char* on : {"1", "true"})
    CHECK(read_with(std::string(R"({"generate": "icosphere", "smooth": )") + on + "}")
              .meshes[0]
              .is_smooth());
  for (const char* off : {"0", "false"})
    CHECK(!read_with(std::string(R"({"generate": "icosphere", "smooth": )") + off + "}")
               .meshes[0]
               .is_smooth());
}

TEST_CASE("one material serves all triangles") {
  CHECK(names_of_materials(read_with(R"({"generate": "box", "material": "b"})")) == names(12, "b"));
  CHECK(names_of_materials(read_with(R"({"generate": "room", "material": "c"})")) ==
        names(10, "c"));
}

TEST_CASE("a material for each slot: the walls of a room") {
  const scene s = read_with(R"({"generate": "room", "materials": ["a", "b", "c", "b", "a"]})");
  CHECK(names_of_materials(s) == names{"a", "a", "b", "b", "c", "c", "b", "b", "a", "a"});
}

TEST_CASE("a pattern of materials goes over the triangles in turn") {
  const scene s = read_with(R"({"generate": "box", "material_pattern": ["a", "c", "c"]})");
  CHECK(names_of_materials(s) == names{"a", "c", "c", "a", "c", "c", "a", "c", "c", "a", "c", "c"});
}

TEST_CASE("a mesh without a material takes the one named default, made up if there is none") {
  const scene made_up = read_with(R"({"generate": "box"})");
  CHECK(made_up.materials.size() == 4);
  CHECK(names_of_materials(made_up) == names(12, "default"));
  const scene given =
      read_with(scratch_folder(), R"({"generate": "box"})", R"("default": {"Kd": 0.25}, "a": {})");
  CHECK(given.materials.size() == 2);
  CHECK(given.materials[given.meshes[0].material_of(3)].Kd.x == 0.25f);
}

TEST_CASE("a file's own materials join the scene, unless the scene has one of that name") {
  const scratch_folder folder;
  folder.write("mesh/two.obj", triangle);
  folder.write("mesh/two.mtl", two_materials);
  const scene own = read_with(folder, R"({"file": "mesh/two.obj"})");
  CHECK(names_of_materials(own) == names{"m.first", "m.second"});
  CHECK(own.materials[own.meshes[0].material_of(1)].Kd.x == 0.2f);
  const scene replaced =
      read_with(folder, R"({"file": "mesh/two.obj"})", R"("second": {"Kd": 0.75})");
  CHECK(names_of_materials(replaced) == names{"m.first", "second"});
  CHECK(replaced.materials[replaced.meshes[0].material_of(1)].Kd.x == 0.75f);
  CHECK(names_of_materials(read_with(
            folder, R"({"file": "mesh/two.obj", "materials": ["b", "a"]})")) == names{"b", "a"});
}

TEST_CASE("a mesh is loaded once, however many instances it has") {
  const scratch_folder folder;
  const scene s = facet::read_json(folder.write("s.json", R"({
    "meshes": {"b": {"generate": "box"}, "a": {"generate": "plane"}},
    "instances": [{"mesh": "b"}, {"mesh": "a"}, {"mesh": "b"}, {"mesh": "b"}]})"));
  CHECK(s.meshes.size() == 2);
  CHECK(s.triangle_count() == 14);
  CHECK(s.meshes[s.instances[3].mesh].name == "b");
  CHECK(s.meshes[s.instances[1].mesh].name == "a");
}

TEST_CASE("what is wrong with a generated mesh is told at its place") {
  CHECK(fault("3").place() == "/meshes/m");
  CHECK(contains(fault("{}").what(), "either \"file\" or \"generate\""));
  CHECK(contains(fault(R"({"file": "a.obj", "generate": "box"})").what(), "either"));
  const auto kind = fault(R"({"generate": "icospere"})");
  CHECK(kind.place() == "/meshes/m/generate");
  CHECK(contains(kind.what(), "did you mean \"icosphere\"?"));
  const auto parameter = fault(R"({"generate": "icosphere", "subdivision": 2})");
  CHECK(parameter.place() == "/meshes/m/subdivision");
  CHECK(contains(parameter.what(), "did you mean \"subdivisions\"?"));
  const auto range = fault(R"({"generate": "icosphere", "subdivisions": 60})");
  CHECK(range.place() == "/meshes/m/subdivisions");
  CHECK(contains(range.what(), "60"));
  CHECK(fault(R"({"generate": "icosphere", "subdivisions": 1.5})").place() ==
        "/meshes/m/subdivisions");
  CHECK(contains(fault(R"({"generate": "box", "x": true})").what(), "expected a number"));
}

TEST_CASE("what is wrong with a choice of materials is told at its place") {
  CHECK(contains(fault(R"({"generate": "box", "material": "a", "materials": ["a"]})").what(),
                 "more than one of"));
  CHECK(fault(R"({"generate": "box", "material_pattern": []})").place() ==
        "/meshes/m/material_pattern");
  CHECK(fault(R"({"generate": "box", "material_pattern": ["a", "d"]})").place() ==
        "/meshes/m/material_pattern/1");
  CHECK(contains(fault(R"({"generate": "room", "materials": ["a", "b"]})").what(),
                 "names 2 materials; this mesh has 5 slots"));
  CHECK(contains(fault(R"({"generate": "box", "material": "glass"})").what(),
                 "there is no material \"glass\"; there are: \"a\", \"b\", \"c\""));
}

TEST_CASE("a mesh file outside the scene's folder is refused, by whatever way it leaves") {
  const scratch_folder outside, folder;
  outside.write("two.obj", triangle);
  const auto refused = [&](const std::string& path) {
    const auto e = fault(folder, R"({"file": ")" + path + "\"}");
    return e.place() == "/meshes/m/file" && contains(e.what(), "leaves the scene's folder");
  };
  CHECK(refused((outside.path() / "two.obj").string()));
  CHECK(refused("../" + outside.path().filename().string() + "/two.obj"));
  folder.write("mesh/two.obj", triangle);
  CHECK(refused("mesh/../mesh/two.obj"));
  std::filesystem::create_symlink(outside.path() / "two.obj", folder.path() / "link.obj");
  CHECK(refused("link.obj"));
  std::filesystem::create_directory_symlink(outside.path(), folder.path() / "away");
  CHECK(refused("away/two.obj"));
}

TEST_CASE("a symbolic link that stays in the scene's folder is followed") {
  const scratch_folder folder;
  folder.write("mesh/two.obj", triangle);
  std::filesystem::create_symlink("mesh/two.obj", folder.path() / "link.obj");
  CHECK(read_with(folder, R"({"file": "link.obj"})").triangle_count() == 2);
  CHECK(read_with(folder, R"({"file": "./mesh/two.obj"})").triangle_count() == 2);
}

TEST_CASE("a mesh file that is not there, or not a mesh file, is told as such") {
  const scratch_folder folder;
  std::filesystem::create_directory(folder.path() / "folder.obj");
  folder.write("mesh.stl", "solid");
  CHECK(contains(fault(folder, R"({"file": "none.obj"})").what(), "there is no file \"none.obj\""));
  CHECK(contains(fault(folder, R"({"file": "folder.obj"})").what(), "is not a file"));
  CHECK(contains(fault(folder, R"({"file": "mesh.stl"})").what(), ".obj or .ply"));
  CHECK(contains(fault(folder, R"({"file": "a\u0000.obj"})").what(), "code 0"));
  CHECK(contains(fault(folder, R"({"file": 7})").what(), "the path of a mesh file, found 7"));
}

TEST_CASE("notes about a mesh file name it") {
  const scratch_folder folder;
  folder.write("two.obj", triangle);  // its material file is missing
  const scene s = read_with(folder, R"({"file": "two.obj"})");
  REQUIRE(!s.notes.empty());
  CHECK(contains(s.notes[0], "two.obj: "));
}
