#include "scene/read_json.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scene/schema_helper.hpp"
#include "scene/scratch_folder.hpp"

using facet::scene;
using facet::vec3d;
using facet::vec3f;
using facet::test::contains;
using facet::test::error_of;
using facet::test::scene_schema;
using facet::test::schema_fault;
using facet::test::scratch_folder;

namespace {

scene read(const std::string& text) {
  const scratch_folder folder;
  return facet::read_json(folder.write("it.json", text));
}

/// A scene of one triangle-poor box with further keys.
std::string with(const std::string& more) {
  return R"({"meshes": {"box": {"generate": "box"}}, "instances": [{"mesh": "box"}])" +
         (more.empty() ? "" : ", " + more) + "}";
}
std::string with_transform(const std::string& transform) {
  return R"({"meshes": {"box": {"generate": "box"}},
             "instances": [{"mesh": "box", "transform": )" +
         transform + "}]}";
}

facet::scene_error fault(const std::string& text) {
  return error_of([&] { read(text); });
}

}  // namespace

TEST_CASE("what is left out takes the defaults of the scene model") {
  const scene s = read(with(R"("camera": {}, "picture": {}, "materials": {"clay": {}})"));
  const scene plain;
  CHECK(s.name == "it");
  CHECK(s.width == plain.width);
  CHECK(s.height == plain.height);
  CHECK(s.max_depth == plain.max_depth);
  CHECK(s.samples == plain.samples);
  CHECK(s.view.position == plain.view.position);
  CHECK(s.view.vertical_fov == plain.view.vertical_fov);
  CHECK(s.background == plain.background);
  CHECK(s.background_alpha == 1);
  CHECK(s.ambient == plain.ambient);
  CHECK(s.lights.empty());
  CHECK(s.notes.empty());
  facet::material clay;
  clay.name = "clay";
  CHECK(s.materials[0] == clay);
}

TEST_CASE("every key arrives where it belongs") {
  const scene s = read(R"({
    "$schema": "facet-scene.schema.json", "about": "all there is",
    "camera": {"position": [1, 2, 3], "look_at": [4, 5, 6], "up": [0, 0, 1], "vertical_fov": 33},
    "picture": {"width": 320, "height": 200, "max_depth": 7, "samples": 3},
    "ambient": [0.1, 0.2, 0.3], "background": [0.4, 0.5, 0.6, 0.7], "nesting": 4,
    "materials": {"m": {"Ke": 1, "Ka": [2, 3, 4], "Kd": 0.5, "Ks": 0.25, "Ns": 9, "Kr": 0.125,
                        "Kt": [1, 0, 0.5], "Ni": 1.5, "attenuation": 0.75,
                        "attenuation_distance": 2}},
    "meshes": {"b": {"generate": "box", "size": 2, "material": "m"}},
    "instances": [{"mesh": "b"}, {"mesh": "b", "material": "m"}],
    "lights": [{"type": "point", "position": [7, 8, 9], "colour": 2, "attenuation": [1, 2, 3]},
               {"type": "directional", "direction": [0, -2, 0], "colour": [1, 0.5, 0]}]})");
  CHECK(s.view.position == vec3d(1, 2, 3));
  CHECK(s.view.look_at == vec3d(4, 5, 6));
  CHECK(s.view.up == vec3d(0, 0, 1));
  CHECK(s.view.vertical_fov == 33);
  CHECK(s.width == 320);
  CHECK(s.height == 200);
  CHECK(s.max_depth == 7);
  CHECK(s.samples == 3);
  CHECK(s.ambient == vec3f(0.1f, 0.2f, 0.3f));
  CHECK(s.background == vec3f(0.4f, 0.5f, 0.6f));
  CHECK(s.background_alpha == 0.7f);
  CHECK(s.nesting == 4);
  REQUIRE(s.materials.size() == 1);
  const facet::material& m = s.materials[0];
  CHECK(m.Ke == vec3f(1, 1, 1));
  CHECK(m.Ka == vec3f(2, 3, 4));
  CHECK(m.Kd.y == 0.5f);
  CHECK(m.Ks.z == 0.25f);
  CHECK(m.Ns == 9);
  CHECK(m.Kr.x == 0.125f);
  CHECK(m.Kt == vec3f(1, 0, 0.5f));
  CHECK(m.Ni == 1.5f);
  CHECK(m.has_attenuation);
  CHECK(m.attenuation.x == 0.75f);
  CHECK(m.attenuation_distance == 2);
  CHECK(s.meshes[0].bounds().hi == vec3f(1, 1, 1));
  CHECK(s.instances[0].material == facet::instance::own_materials);
  CHECK(s.instances[1].material == 0);
  REQUIRE(s.lights.size() == 2);
  CHECK(s.lights[0].position == vec3d(7, 8, 9));
  CHECK(s.lights[0].colour == vec3f(2, 2, 2));
  CHECK(s.lights[0].quadratic == 3);
  CHECK(s.lights[1].type == facet::light::kind::directional);
  CHECK(s.lights[1].direction == vec3d(0, -2, 0));
}

TEST_CASE("the steps of a transform are applied from first to last") {
  const auto moved = [](const std::string& transform) {
    return read(with_transform(transform)).instances[0].world_from_object.point({1, 2, 3});
  };
  CHECK(moved(R"([{"translate": [1, 0, 0]}, {"scale": 2}])") == vec3d(4, 4, 6));
  CHECK(moved(R"([{"scale": [2, 1, -1]}, {"translate": [1, 0, 0]}])") == vec3d(3, 2, -3));
  CHECK(moved(R"([{"rotate": {"axis": [0, 0, 5], "degrees": 90}}, {"translate": [0, 0, 1]}])") ==
        vec3d(-2, 1, 4));
  CHECK(moved("[]") == vec3d(1, 2, 3));
}

TEST_CASE("a matrix is read row by row, with or without its fourth row") {
  for (const char* last : {"", ", 0, 0, 0, 1"}) {
    const scene s = read(with_transform(
        std::string(R"({"matrix": [2, 0, 0, 1,  0, 3, 0, 2,  0, 0, 4, 3)") + last + "]}"));
    CHECK(s.instances[0].world_from_object.point({1, 1, 1}) == vec3d(3, 5, 7));
  }
}

TEST_CASE("a scene without a camera gets one, and says so") {
  const scene s = read(R"({"meshes": {"box": {"generate": "box"}}, "instances": [
    {"mesh": "box", "transform": [{"translate": [100, 0, 0]}]}]})");
  REQUIRE(s.notes.size() == 1);
  CHECK(contains(s.notes[0], "no camera"));
  CHECK(s.view.look_at.x == doctest::Approx(100).epsilon(1e-12));
}

TEST_CASE("a scene without instances is its background, and says so") {
  const scene s = read(R"({"camera": {}, "meshes": {}, "instances": []})");
  CHECK(s.materials.size() == 1);
  REQUIRE(s.notes.size() == 1);
  CHECK(contains(s.notes[0], "no instances"));
}

namespace {

struct bad_scene {
  std::string text, place, part;
  bool schema_knows;  ///< the schema refuses it, too; it cannot know names, files and directions
};

const std::vector<bad_scene>& bad_scenes() {
  static const std::vector<bad_scene> all{
      {"[]", "", "expected a scene, which is an object, found an array of 0", true},
      {"{}", "", "the key \"meshes\" is missing", true},
      {R"({"meshes": {}})", "", "the key \"instances\" is missing", true},
      {with(R"("light": [])"), "/light", "did you mean \"lights\"?", true},
      {with(R"("camera": {"fov": 40})"), "/camera/fov", "\"vertical_fov\"", true},
      {with(R"("camera": {"position": [0, 1]})"), "/camera/position", "an array of 2", true},
      {with(R"("camera": {"position": [0, 0, 0]})"), "/camera/look_at", "no direction", false},
      {with(R"("camera": {"up": [0, 0, 1]})"), "/camera/up", "line of sight", false},
      {with(R"("camera": {"vertical_fov": 180})"), "/camera/vertical_fov", "between 0 and", true},
      {with(R"("picture": {"width": 0})"), "/picture/width", "from 1 to 32768, found 0", true},
      {with(R"("picture": {"height": 1e9})"), "/picture/height", "from 1 to 32768", true},
      {with(R"("picture": {"samples": 1.5})"), "/picture/samples", "whole number", true},
      {with(R"("picture": {"max_depth": "5"})"), "/picture/max_depth", "the text \"5\"", true},
      {with(R"("ambient": "white")"), "/ambient", "one for all three", true},
      {with(R"("ambient": -1)"), "/ambient", "at least 0", true},
      {with(R"("background": [0, 0, 0, 2])"), "/background/3", "from 0 to 1", true},
      {with(R"("background": [0, 0])"), "/background", "a colour", true},
      {with(R"("materials": [])"), "/materials", "an object of materials", true},
      {with(R"("materials": {"a": {"kd": 1}})"), "/materials/a/kd", "did you mean \"Kd\"?", true},
      {with(R"("materials": {"a/b": {"Kt": 2}})"), "/materials/a~1b/Kt", "from 0 to 1", true},
      {with(R"("materials": {"a": {"Ni": 0}})"), "/materials/a/Ni", "greater than 0", true},
      {with(R"("materials": {"a": {"Ns": 1e39}})"), "/materials/a/Ns", "3.4e38", false},
      {with(R"("lights": {})"), "/lights", "an array of lights", true},
      {with(R"("lights": [[]])"), "/lights/0", "a light, which is an object", true},
      {with(R"("lights": [{}])"), "/lights/0", "\"type\" is missing", true},
      {with(R"("lights": [{"type": "pont"}])"), "/lights/0/type", "did you mean \"point\"?", true},
      {with(R"("lights": [{"type": "point"}])"), "/lights/0", "\"position\" is missing", true},
      {with(R"("lights": [{"type": "directional", "direction": [0, 0, 0]}])"),
       "/lights/0/direction", "any length", false},
      {with(
           R"("lights": [{"type": "directional", "direction": [0, -1, 0], "attenuation": [1, 0, 0]}])"),
       "/lights/0/attenuation", "in a directional light", true},
      {with(R"("lights": [{"type": "point", "position": [0, 1, 0], "attenuation": [1, -1, 0]}])"),
       "/lights/0/attenuation", "at least 0", true},
      {R"({"meshes": {}, "instances": {}})", "/instances", "an array of instances", true},
      {R"({"meshes": {}, "instances": [{}]})", "/instances/0", "\"mesh\" is missing", true},
      {R"({"meshes": {"box": {"generate": "box"}}, "instances": [{"mesh": "bix"}]})",
       "/instances/0/mesh", "did you mean \"box\"?", false},
      {R"({"meshes": {"b": {"generate": "box"}}, "materials": {"glass": {}},
           "instances": [{"mesh": "b", "material": "glas"}]})",
       "/instances/0/material", "did you mean \"glass\"? There are: \"glass\"", false},
      {with_transform("3"), "/instances/0/transform", "an array of steps", true},
      {with_transform(R"({"matrix": [1, 2, 3]})"), "/instances/0/transform/matrix", "12 or 16",
       true},
      {with_transform(R"({"matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,1,0]})"),
       "/instances/0/transform/matrix", "fourth row", false},
      {with_transform(R"([{"translate": [1, 2, 3], "scale": 2}])"), "/instances/0/transform/0",
       "exactly one", true},
      {with_transform(R"([{}])"), "/instances/0/transform/0", "exactly one", true},
      {with_transform(R"([{"rotate": {"axis": [0, 0, 0], "degrees": 9}}])"),
       "/instances/0/transform/0/rotate/axis", "any length", false},
      {with_transform(R"([{"rotate": {"axis": [0, 0, 1]}}])"), "/instances/0/transform/0/rotate",
       "\"degrees\" is missing", true},
      {with_transform(R"([{"scale": 0}])"), "/instances/0/transform", "singular", true},
      {with_transform(R"([{"scale": [1, 0, 1]}])"), "/instances/0/transform", "singular", true},
      {with_transform(R"([{"skale": 2}])"), "/instances/0/transform/0/skale",
       "did you mean \"scale\"?", true},
  };
  return all;
}

}  // namespace

TEST_CASE("a bad scene says where, what was found and what is allowed") {
  for (const bad_scene& bad : bad_scenes()) {
    CAPTURE(bad.text);
    const auto e = fault(bad.text);
    CHECK(e.place() == bad.place);
    CHECK(contains(e.what(), bad.part));
    CHECK(contains(e.file(), "it.json"));
  }
}

TEST_CASE("the schema refuses what the reader refuses, but for names, files and directions") {
  for (const bad_scene& bad : bad_scenes()) {
    CAPTURE(bad.text);
    CHECK(schema_fault(nlohmann::json::parse(bad.text), scene_schema()).empty() !=
          bad.schema_knows);
  }
}

TEST_CASE("too many instances and lights are refused before they are read") {
  std::string lights;
  for (int i = 0; i < 1025; ++i) lights += i ? ", 0" : "0";
  const auto e = fault(with("\"lights\": [" + lights + "]"));
  CHECK(e.place() == "/lights");
  CHECK(contains(e.what(), "holds 1025 lights; at most 1024"));
}
