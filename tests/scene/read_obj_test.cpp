#include "scene/read_obj.hpp"

#include <doctest/doctest.h>

#include <locale>

#include "scene/mesh_checks.hpp"
#include "scene/scratch_folder.hpp"

using namespace facet;
using namespace facet::test;

namespace {

using numbers = std::vector<std::uint32_t>;

mesh_file read_text(const std::string& text) {
  const scratch_folder scratch;
  return read_obj(scratch.write("thing.obj", text));
}
scene_error error_of_text(const std::string& text) {
  return error_of([&] { read_text(text); });
}

const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("a face is a fan around its first corner, whatever its shape and size") {
  const mesh_file file = read_text(corners + "f 1 2 3 4\nf 2 4 3\n");
  CHECK(file.mesh.indices == numbers{0, 1, 2, 0, 2, 3, 1, 3, 2});
  CHECK(file.mesh.name == "thing");
  CHECK(!file.mesh.is_smooth());
  CHECK(file.mesh.dropped == 0);
  CHECK(file.materials.empty());
  CHECK(file.notes.empty());

  std::string polygon = "f";
  for (int i = 0; i < 1000; ++i) polygon += i % 2 ? " 2" : " 3";
  CHECK(read_text(corners + polygon).mesh.triangle_count() == 998);
}

TEST_CASE("spellings of a face and line ends make no difference") {
  const numbers expected{0, 1, 2};
  const std::string lists = corners + "vt 0 0\nvn 0 0 1\n";
  for (const char* face :
       {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f -4 -3 -2",
        "f -4//-1 -3//-1 -2//-1", "  f   1\t2 3  ", "f 1 2 3 # a comment 4", "f 1 2 \\\n 3"}) {
    CAPTURE(face);
    const mesh_file file = read_text(lists + face);
    CHECK(file.mesh.indices == expected);
    CHECK(broken_promise(file.mesh) == "");
    CHECK(file.mesh.is_smooth() == (std::string(face).find("//") != std::string::npos ||
                                    std::string(face).find("/1/1") != std::string::npos));
    for (const char* end : {"\r\n", "\r"}) {
      std::string text;
      for (char c : lists + face + '\n') text += c == '\n' ? end : std::string(1, c);
      CHECK(read_text(text).mesh.indices == expected);
    }
  }
}

TEST_CASE("coordinates are read to the nearest float, in any locale") {
  struct comma : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new comma));
  const mesh_file file = read_text("v 0.1 +1e-3 -.5\nv 16777217.5 1e-50 5.\nv 1234.5 0 0\nf 1 2 3");
  std::locale::global(before);
  CHECK(file.mesh.positions[0] == vec3f(0.1f, 1e-3f, -.5f));
  CHECK(file.mesh.positions[1] == vec3f(16777218.f, 0, 5));
  CHECK(file.mesh.positions[2].x == 1234.5f);
}

TEST_CASE("an index that names nothing is an error that gives the line and what is allowed") {
  scene_error e = error_of_text(corners + "\nf 1 2 5\nf 1 2 3\n");
  CHECK(e.place() == "line 6");
  CHECK(contains(e.what(), "vertex 5; allowed are 1 to 4, or -4 to -1"));
  CHECK(error_of_text("v 0 0 0\r\nv 1 0 0\r\nf 1 2 3\r\nf 1 2 2\r\n").place() == "line 3");
  CHECK(error_of_text("v 0 0 0 \\\n1\nv 1 0 0\n#\nf 1 2 3\n").place() == "line 5");
  e = error_of_text(corners + "f 1 2 -5\n");
  CHECK(e.place() == "line 5");
  CHECK(contains(e.what(), "vertex -5"));
  CHECK(error_of_text(corners + "f 1 2 0\n").place() == "line 5");
  CHECK(error_of_text(corners + "f 1 2 x\n").place() == "line 5");
  CHECK(contains(error_of_text(corners + "f 1//1 2//1 3//1\n").what(), "normal 1; there is none"));
  CHECK(contains(error_of_text(corners + "vn 0 0 1\nf 1//1 2//-2 3//1\n").what(), "normal -2"));
  CHECK(contains(error_of_text(corners + "f 1 2 4294967299\n").what(), "more than 9 digits"));
  CHECK(contains(error_of_text("f 1 2 3\n").what(), "vertex 3; there is none"));
}

TEST_CASE("a face may name vertices that follow it") {
  CHECK(read_text("f 1 2 3\n" + corners).mesh.indices == numbers{0, 1, 2});
}

TEST_CASE("triangles with unusable coordinates are dropped, counted, and leave the others' ids") {
  for (const char* bad : {"v nan 0 0", "v 0 inf 0", "v 0 0 -1e19", "v 1e39 0 0", "v 1e999 0 0",
                          "v 1,5 0 0", "v 0 0", "v ", "v a b c", "v 1.#QNAN 0 0"}) {
    CAPTURE(bad);
    const mesh_file file =
        read_text(corners + bad + "\nf 1 2 3\nf 1 2 3 5\nf 5 1 2\nf 1 2 3 4\nf 1 3 4\n");
    CHECK(file.mesh.indices == numbers{0, 1, 2, 0, 1, 2, 0, 1, 2, 0, 2, 3, 0, 2, 3});
    CHECK(file.mesh.source == numbers{0, 1, 4, 5, 6});
    CHECK(file.mesh.dropped == 2);
    CHECK(broken_promise(file.mesh) == "");
    REQUIRE(file.notes.size() == 1);
    CHECK(contains(file.notes[0], "2 triangles dropped"));
    CHECK(contains(file.notes[0], "line 5"));
  }
  const mesh_file largest = read_text("v 1e18 0 0\nv 0 -1e18 0\nv 0 0 1e18\nf 1 2 3");
  CHECK(largest.mesh.dropped == 0);
  CHECK(contains(error_of_text("v 1,5 0 0\nf 1 1 1\n").what(), "line 1, \"v 1,5 0 0\""));
}

TEST_CASE("a file without triangles is an error, and thin faces are ignored with a note") {
  CHECK(contains(error_of_text("").what(), "no triangle"));
  CHECK(contains(error_of_text(corners).what(), "found 0 faces"));
  CHECK(contains(error_of_text(corners + "f 1 2\nf 1\n").what(), "found 2 faces, none with 3"));
  CHECK(contains(error_of_text("\0\xff\x7f garbage").what(), "no triangle"));
  const mesh_file file = read_text(corners + "f 1 2\nl 1 2\np 1\nf 1 2 3\nf 3\n");
  CHECK(file.mesh.triangle_count() == 1);
  REQUIRE(file.notes.size() == 1);
  CHECK(contains(file.notes[0], "2 faces with fewer than 3 corners"));
}

TEST_CASE("a missing file, a folder and a device are errors that name the path") {
  const scratch_folder scratch;
  const auto missing = scratch.path() / "none.obj";
  CHECK(error_of([&] { read_obj(missing); }).file() == missing.string());
  CHECK(contains(error_of([&] { read_obj(missing); }).what(), "no such file"));
  CHECK(contains(error_of([&] { read_obj(scratch.path()); }).what(), "not a regular file"));
  CHECK(contains(error_of([&] { read_obj("/dev/zero"); }).what(), "not a regular file"));
}

TEST_CASE("normals are made unit, and a face has its own where it has none that are usable") {
  const mesh_file file = read_text(corners +
                                   "vn 0 0 2\nvn 0 3e-30 4e-30\nvn 0 0 0\nvn nan 0 1\n"
                                   "f 1//1 2//2 3//1\nf 1 3 4\nf 1//1 3//3 4//2\nf 4//4 3//1 1//1\n"
                                   "f 1//1 2//1 3\n");
  const mesh& m = file.mesh;
  CHECK(broken_promise(m) == "");
  REQUIRE(m.is_smooth());
  CHECK(m.normal(0, 0) == vec3f(0, 0, 1));
  CHECK(m.normal(0, 1) == vec3f(0, 0.6f, 0.8f));
  for (int k = 0; k < 3; ++k) CHECK(m.normal(1, k) == vec3f(0, 0, 1));
  CHECK(m.normal(2, 1) == vec3f(0, 0, 1));
  CHECK(m.normal(2, 2) == vec3f(0, 0.6f, 0.8f));
  CHECK(m.normal(3, 0) == vec3f(0, 0, -1));  // this face is wound the other way
  CHECK(m.normal(3, 1) == vec3f(0, 0, 1));
  for (int k = 0; k < 3; ++k) CHECK(m.normal(4, k) == vec3f(0, 0, 1));
  CHECK(any_holds(file.notes, "2 triangles with a normal of length 0 or not finite"));
  CHECK(any_holds(file.notes, "2 triangles without normals among others with"));
  // The normals of a dropped triangle go with it.
  const mesh_file rest = read_text(corners + "v nan 0 0\nvn 1 0 0\nf 1//1 2//1 5//1\nf 1 2 3\n");
  CHECK(!rest.mesh.is_smooth());
}

TEST_CASE("materials come from the mtllib, in its order, and faces index them") {
  const scratch_folder scratch;
  scratch.write("two words.mtl", "newmtl red paint\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n");
  scratch.write("more.mtl", "newmtl green\nKd 0 1 0\nmap_Kd grass.png\n");
  const auto path =
      scratch.write("m.obj", "mtllib two words.mtl\nmtllib more.mtl none.mtl\n" + corners +
                                 "usemtl blue\nf 1 2 3\nf 1 2\nusemtl red paint \n"
                                 "f 1 3 4 2\nusemtl green\nf 1 2 4\n");
  const mesh_file file = read_obj(path);
  REQUIRE(file.materials.size() == 3);
  CHECK(file.materials[0].name == "red paint");
  CHECK(file.materials[0].Kd == vec3f(1, 0, 0));
  CHECK(file.materials[2].name == "green");
  CHECK(file.mesh.materials == numbers{1, 0, 0, 2});
  CHECK(any_holds(file.notes, "more.mtl: line 3: \"map_Kd\" is a texture"));
  CHECK(any_holds(file.notes, "m.obj: mtllib \"none.mtl\" is not there"));
}

TEST_CASE("names that no mtllib defines get a default material of that name, and a note") {
  const scratch_folder scratch;
  scratch.write("m.mtl", "newmtl glass\nKd 0 0 1\n");
  const auto path = scratch.write(
      "m.obj", "mtllib m.mtl\n" + corners + "f 1 2 3\nusemtl glas\nf 1 2 4\nusemtl glass\nf 1 3 4");
  const mesh_file file = read_obj(path);
  REQUIRE(file.materials.size() == 3);
  material expected;
  expected.name = "default";
  CHECK(file.materials[1] == expected);
  expected.name = "glas";
  CHECK(file.materials[2] == expected);
  CHECK(file.mesh.materials == numbers{1, 2, 0});
  CHECK(any_holds(file.notes, "did you mean \"glass\""));
  CHECK(any_holds(file.notes, "before the first usemtl"));
}

TEST_CASE("an mtllib outside of the file's folder is not read") {
  const scratch_folder scratch;
  scratch.write("secret.mtl", "newmtl a\nKd 1 0 0\n");
  const std::string absolute = (scratch.path() / "secret.mtl").string();
  scratch.write("in/inner/a.mtl", "newmtl a\nKd 0 1 0\n");
  std::filesystem::create_symlink(absolute, scratch.path() / "in/link.mtl");
  for (const std::string& name : {std::string("../secret.mtl"), absolute, std::string("link.mtl"),
                                  std::string("..\\secret.mtl")}) {
    CAPTURE(name);
    const mesh_file file = read_obj(
        scratch.write("in/m.obj", "mtllib " + name + "\nusemtl a\n" + corners + "f 1 2 3"));
    REQUIRE(file.materials.size() == 1);
    CHECK(file.materials[0].Kd == material().Kd);
    CHECK(any_holds(file.notes, "outside of the file's folder"));
  }
  const mesh_file inner =
      read_obj(scratch.write("in/m.obj", "mtllib inner\\a.mtl\nusemtl a\n" + corners + "f 1 2 3"));
  CHECK(inner.materials.at(0).Kd == vec3f(0, 1, 0));
}

TEST_CASE("no truncated or scrambled file crashes the reader or breaks a promise") {
  const scratch_folder scratch;
  scratch.write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKs 1\nillum 3\n");
  std::string text = "# a square and a bend\nmtllib m.mtl\no thing\n" + corners +
                     "v 0.5 0.5 1e-3\nvt 0 1\nvn 0 0 1\nvn 0.6 0 0.8\ng one two\ns 1\nusemtl a\n"
                     "f 1/1/1 2/1/2 3/1/1 4/1/1\nusemtl b\nf 1//1 -1//-1 2//2\nf 3 4 5\nl 1 2\n";
  const auto path = scratch.path() / "m.obj";
  const auto survives = [&](const std::string& variant) {
    scratch.write("m.obj", variant);
    try {
      const mesh_file file = read_obj(path);
      return broken_promise(file.mesh).empty() &&
             (file.mesh.materials.empty() || file.materials.size() >= 2);
    } catch (const scene_error&) {
      return true;
    }
  };
  REQUIRE(read_obj(scratch.write("m.obj", text)).mesh.triangle_count() == 4);
  int crashes = 0;
  for (std::size_t size = 0; size <= text.size(); ++size)
    crashes += !survives(text.substr(0, size));
  std::uint32_t state = 1;
  const auto random = [&state](std::size_t n) {
    state = state * 1664525u + 1013904223u;
    return std::size_t(state >> 8) % n;
  };
  const std::string letters("0123456789-+.eE/ \n\r\t\\#vfnlptgs\0\xff", 33);
  for (int i = 0; i < 700; ++i) {
    std::string variant = text;
    for (int k = 0; k < 3; ++k) variant[random(text.size())] = letters[random(letters.size())];
    crashes += !survives(variant);
  }
  CHECK(crashes == 0);
}
