#include "scene/read_mtl.hpp"

#include <doctest/doctest.h>

#include "scene/mesh_checks.hpp"
#include "scene/scratch_folder.hpp"

using namespace facet;
using namespace facet::test;

namespace {

struct mtl {
  std::vector<material> materials;
  std::vector<std::string> notes;
};
mtl read_text(const std::string& text) {
  const scratch_folder scratch;
  mtl result;
  result.materials = read_mtl(scratch.write("a.mtl", text), result.notes);
  return result;
}
material only(const std::string& statements) {
  const mtl file = read_text("newmtl m\n" + statements);
  REQUIRE(file.materials.size() == 1);
  return file.materials[0];
}

const vec3f white{1, 1, 1}, black{0, 0, 0};

}  // namespace

TEST_CASE("statements are taken as they are, and what is not stated is 0") {
  const mtl file = read_text(
      "# made by hand\r\nnewmtl two words \r\n\tKe 1 2 3\r\nKa .1 .2 .3\r\nKd 0.5\r\n"
      "Ks 0.25 0 1 # shiny\r\nNs 96.5\r\nNi 1.45\r\nillum 2\r\n\r\nnewmtl b\r\nKs 1 1 1");
  REQUIRE(file.materials.size() == 2);
  const material& m = file.materials[0];
  CHECK(m.name == "two words");
  CHECK(m.Ke == vec3f(1, 2, 3));
  CHECK(m.Ka == vec3f(.1f, .2f, .3f));
  CHECK(m.Kd == vec3f(0.5f, 0.5f, 0.5f));
  CHECK(m.Ks == vec3f(0.25f, 0, 1));
  CHECK(m.Ns == 96.5f);
  CHECK(m.Kr == black);
  CHECK(m.Kt == black);
  CHECK(file.materials[1].name == "b");
  CHECK(file.materials[1].Kd == black);
  CHECK(file.notes.empty());
}

TEST_CASE("a material without a colour, or with a texture for it, has the default one") {
  material expected;
  expected.name = "m";
  CHECK(only("") == expected);
  CHECK(only("illum 2\nNi 1.5\n") == expected);
  CHECK(only("map_Kd a.png\nKs 0 0 0\n").Kd == expected.Kd);
  CHECK(only("map_Kd a.png\nKd 0 0 0\n").Kd == expected.Kd);
  CHECK(only("map_Kd a.png\nKd 0.1 0 0\n").Kd == vec3f(0.1f, 0, 0));
}

TEST_CASE("illum 3, 5 and 8 make Ks a mirror, others do not") {
  for (int illum = 0; illum <= 10; ++illum) {
    CAPTURE(illum);
    const bool mirror = illum == 3 || illum == 5 || illum == 8;
    CHECK(only("Ks 0.5 2 0\nillum " + std::to_string(illum)).Kr ==
          (mirror ? vec3f(0.5f, 1, 0) : black));
  }
}

TEST_CASE("glass is what illum 4, 6, 7 and 9 say, tinted by Tf or as strong as d") {
  for (const char* illum : {"illum 4\n", "illum 6\n", "illum 7\n", "illum 9\n"}) {
    const std::string glass = std::string(illum) + "Ni 1.5\nKd 0.5\n";
    CAPTURE(illum);
    CHECK(only(glass + "Tf 0.9 0.5 0.1\n").Kt == vec3f(0.9f, 0.5f, 0.1f));
    CHECK(only(glass + "Tf 0.9 0.5 0.1\n").Ni == 1.5f);
    CHECK(!only(glass + "Tf 0.9 0.5 0.1\n").has_attenuation);
    CHECK(only(glass).Kt == white);
    CHECK(only(glass + "Tf 1 1 1\n").Kt == white);
    CHECK(only(glass + "d 0.25\n").Kt == white * 0.75f);
    CHECK(only(glass + "d 0.25\n").Kd == white * 0.125f);
    CHECK(only(glass + "Tf 1 1 1\nd 0.25\n").Kt == white * 0.75f);
    CHECK(only(glass + "Tf 0 0.5 0\nd 0.25\n").Kt == vec3f(0, 0.5f, 0));
  }
}

TEST_CASE("what exporters write on opaque materials leaves them opaque") {
  for (const char* filler : {"Tf 1 1 1\nillum 2\n", "Tf 0.5 0.5 0.5\nillum 2\nd 1\nNi 1.5\n",
                             "Tf 1 1 1\nillum 4\nNi 1\n", "Tf 1 1 1\nillum 4\n",
                             "d 1\nTr 0\nillum 2\nNi 1.45\n", "d 1\nTr 1\nillum 2\n"}) {
    CAPTURE(filler);
    const material m = only(std::string("Kd 0.5 0.5 0.5\n") + filler);
    CHECK(m.Kt == black);
    CHECK(m.Kd == white * 0.5f);
  }
}

TEST_CASE("a dissolve shows what is behind, without refraction or thickness") {
  for (const char* dissolve : {"d 0.25\n", "Tr 0.75\n", "d 0.25\nTr 0.1\n", "Tr 0.1\nd 0.25\n",
                               "d -halo 0.25\n", "d 0.25\nTf 1 1 1\n"}) {
    CAPTURE(dissolve);
    const material m = only(std::string("Kd 1\nKa 1\nKs 1\nNi 1.45\nillum 2\n") + dissolve);
    CHECK(m.Kt == white * 0.75f);
    CHECK(m.Kd == white * 0.25f);
    CHECK(m.Ka == white * 0.25f);
    CHECK(m.Ks == white);
    CHECK(m.Ni == 1);
    CHECK(m.has_attenuation);
    CHECK(m.attenuation == white);
  }
  CHECK(only("Tf 0 0.5 1\nd 0.5\n").Kt == vec3f(0, 0.5f, 1));
}

TEST_CASE("values out of range are clamped, with one note for each kind of them") {
  const mtl file = read_text(
      "newmtl a\nKd -1 0.5 0.5\nTf 2 0 0\nd 1.5\nNi 0\nillum 11\nNs -3\n"
      "newmtl b\nKd -1 -1 0\n");
  CHECK(file.materials[0].Kd == vec3f(0, 0.5f, 0.5f));
  CHECK(file.materials[0].Kt == black);
  CHECK(file.materials[0].Ns == 0);
  CHECK(file.materials[1].Kd == black);
  CHECK(file.notes.size() == 6);
  CHECK(any_holds(file.notes, "a.mtl: line 2: Kd below 0: taken as 0 (and 2 more)"));
  CHECK(any_holds(file.notes, "line 3: Tf above 1"));
  CHECK(any_holds(file.notes, "line 4: d above 1"));
  CHECK(any_holds(file.notes, "line 5: Ni not above 0: taken as 1"));
  CHECK(any_holds(file.notes, "line 6: illum"));
}

TEST_CASE("what is no finite number is an error that gives the line") {
  for (const char* bad : {"Kd", "Kd a b c", "Kd 1 2", "Kd 1 x 1", "Ks 0 0 nan", "Ns inf", "Ni 1e39",
                          "d", "d -halo", "Tr 1,0", "illum one", "Kd 0.5.5"}) {
    CAPTURE(bad);
    const scene_error e = error_of([&] { read_text(std::string("newmtl m\n\n") + bad + "\n"); });
    CHECK(e.place() == "line 3");
    CHECK(contains(e.what(), "where a finite number belongs"));
  }
  CHECK(error_of([] { read_text("newmtl\n"); }).place() == "line 1");
}

TEST_CASE("what is not offered is ignored with a note") {
  const mtl file = read_text(
      "Kd 1 1 1\nnewmtl a\nmap_Kd a.png\nmap_Kd b.png\nbump c.png\nKd xyz 1 1 1\nKs spectral f 1\n"
      "Pr 0.5\n");
  CHECK(file.materials.size() == 1);
  CHECK(file.notes.size() == 6);
  CHECK(any_holds(file.notes, "line 1: \"Kd\" before the first newmtl"));
  CHECK(any_holds(file.notes,
                  "line 3: \"map_Kd\" is a texture; textures are not offered: ignored "
                  "(and 1 more)"));
  CHECK(any_holds(file.notes, "\"bump\" is a texture"));
  CHECK(any_holds(file.notes, "Kd xyz"));
  CHECK(any_holds(file.notes, "Ks spectral"));
  CHECK(any_holds(file.notes, "\"Pr\" is not offered"));
}

TEST_CASE("of two materials of one name the later counts, in the place of the first") {
  const mtl file = read_text("newmtl a\nKd 1\nKs 1\nnewmtl b\nnewmtl a\nKd 0.5\n");
  REQUIRE(file.materials.size() == 2);
  CHECK(file.materials[0].Kd == white * 0.5f);
  CHECK(file.materials[0].Ks == black);
  CHECK(any_holds(file.notes, "newmtl \"a\" again"));
}

TEST_CASE("an empty file has no materials, and a missing one is an error with its path") {
  CHECK(read_text("").materials.empty());
  const scratch_folder scratch;
  std::vector<std::string> notes;
  CHECK(error_of([&] { read_mtl(scratch.path() / "no.mtl", notes); }).file() ==
        (scratch.path() / "no.mtl").string());
}
