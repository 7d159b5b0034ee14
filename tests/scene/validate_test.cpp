#include "scene/validate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "scene/scratch_folder.hpp"

using facet::material;
using facet::scene;
using facet::transform;
using facet::validate;
using facet::limits::coordinate;
using facet::test::contains;
using facet::test::error_of;

namespace {

scene good() {
  scene s;
  s.materials.resize(2);
  s.materials[0].name = "clay";
  facet::mesh m;
  m.name = "triangle";
  m.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  m.indices = {0, 1, 2};
  s.meshes = {m};
  s.instances.resize(2);
  s.lights.resize(2);
  s.lights[1].type = facet::light::kind::directional;
  s.lights[1].direction = {0, -1, 0};
  return s;
}

/// The place of the error after a change to a good scene; the file is named in every message.
std::string fault(const std::function<void(scene&)>& change) {
  scene s = good();
  change(s);
  const auto e = error_of([&] { validate(s, "some.json"); });
  CHECK(contains(e.what(), "some.json: " + e.place() + ": "));
  return e.place();
}

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

}  // namespace

TEST_CASE("a good scene passes, without instances and lights too") {
  scene s = good();
  CHECK_NOTHROW(validate(s, ""));
  s.instances.clear(), s.lights.clear(), s.meshes.clear();
  CHECK_NOTHROW(validate(s, ""));
}

TEST_CASE("the picture stays within the limits") {
  CHECK(fault([](scene& s) { s.width = 0; }) == "/picture/width");
  CHECK(fault([](scene& s) { s.height = 32769; }) == "/picture/height");
  CHECK(fault([](scene& s) { s.max_depth = 65; }) == "/picture/max_depth");
  CHECK(fault([](scene& s) { s.nesting = 0; }) == "/nesting");
  CHECK(fault([](scene& s) { s.nesting = 9; }) == "/nesting");
  CHECK(fault([](scene& s) { s.samples = 0; }) == "/picture/samples");
  CHECK(fault([](scene& s) { s.samples = 17; }) == "/picture/samples");
  scene s = good();
  s.width = s.height = 32768, s.max_depth = 64, s.samples = 16;
  CHECK_NOTHROW(validate(s, ""));
}

TEST_CASE("colours are finite and not negative; alpha, Kr and Kt are at most 1") {
  CHECK(fault([](scene& s) { s.ambient.y = -0.1f; }) == "/ambient");
  CHECK(fault([](scene& s) { s.background.z = not_a_number; }) == "/background");
  CHECK(fault([](scene& s) { s.background_alpha = 1.5f; }) == "/background/3");
  CHECK(fault([](scene& s) { s.background_alpha = not_a_number; }) == "/background/3");
  CHECK(fault([](scene& s) { s.materials[0].Ke.x = infinity; }) == "/materials/clay/Ke");
  CHECK(fault([](scene& s) { s.materials[0].Ka.x = -1; }) == "/materials/clay/Ka");
  CHECK(fault([](scene& s) { s.materials[1].Kd.x = -1; }) == "/materials/1/Kd");
  CHECK(fault([](scene& s) { s.materials[1].Ks.x = not_a_number; }) == "/materials/1/Ks");
  CHECK(fault([](scene& s) { s.materials[0].Kr.x = 1.01f; }) == "/materials/clay/Kr");
  CHECK(fault([](scene& s) { s.materials[0].Kt.z = 1.01f; }) == "/materials/clay/Kt");
  CHECK(fault([](scene& s) { s.lights[1].colour.x = -1; }) == "/lights/1/colour");
  scene s = good();
  s.materials[0].Kr = s.materials[0].Kt = {1, 1, 1};
  s.materials[0].Ke = s.lights[0].colour = {1e30f, 0, 0};
  CHECK_NOTHROW(validate(s, ""));
}

TEST_CASE("exponents, indices of refraction and attenuation keep their ranges") {
  CHECK(fault([](scene& s) { s.materials[0].Ns = -1; }) == "/materials/clay/Ns");
  CHECK(fault([](scene& s) { s.materials[0].Ns = infinity; }) == "/materials/clay/Ns");
  CHECK(fault([](scene& s) { s.materials[0].Ni = 0; }) == "/materials/clay/Ni");
  CHECK(fault([](scene& s) { s.materials[0].Ni = not_a_number; }) == "/materials/clay/Ni");
  const auto glass = [](auto change) {
    return fault([&](scene& s) {
      s.materials[0].Kt = {1, 1, 1};
      s.materials[0].has_attenuation = true;
      s.materials[0].attenuation = {0, 0.5f, 1};
      change(s.materials[0]);
    });
  };
  CHECK(glass([](material& m) { m.attenuation.x = 1.5f; }) == "/materials/clay/attenuation");
  CHECK(glass([](material& m) { m.attenuation_distance = 0; }) ==
        "/materials/clay/attenuation_distance");
  // -ln(1e-30) / 1e-38 is about 7e39, beyond float.
  CHECK(glass([](material& m) { m.attenuation_distance = 1e-38f; }) ==
        "/materials/clay/attenuation_distance");
}

TEST_CASE("a scene has a material") {
  CHECK(fault([](scene& s) { s.materials.clear(); }) == "/materials");
}

TEST_CASE("meshes: every index points at what is there") {
  CHECK(fault([](scene& s) { s.meshes[0].indices[1] = 3; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].indices.push_back(0); }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].indices.clear(); }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].materials = {2}; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].materials = {0, 0}; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].source = {0, 1}; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) {
          s.meshes[0].name = "";
          s.meshes[0].normal_indices = {0, 0, 0};
        }) == "/meshes/0");
}

TEST_CASE("meshes: normals are of length 1, positions finite and within reach") {
  CHECK(fault([](scene& s) {
          s.meshes[0].normals = {{0, 0, 1.01f}};
          s.meshes[0].normal_indices = {0, 0, 0};
        }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].positions[2].y = not_a_number; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].positions[0].x = -infinity; }) == "/meshes/triangle");
  CHECK(fault([](scene& s) { s.meshes[0].positions[0].x = 1.1e18f; }) == "/meshes/triangle");
  scene s = good();
  s.meshes[0].positions[0].x = coordinate;
  s.meshes[0].positions.push_back({not_a_number, infinity, 0});  // used by no triangle
  CHECK_NOTHROW(validate(s, ""));
}

TEST_CASE("instances: mesh and material exist") {
  CHECK(fault([](scene& s) { s.instances[1].mesh = 1; }) == "/instances/1/mesh");
  CHECK(fault([](scene& s) { s.instances[0].material = 2; }) == "/instances/0/material");
}

TEST_CASE("instances: a transform that flattens is refused, a thin one is not") {
  const auto with = [](const transform& t) {
    return [t](scene& s) { s.instances[1].world_from_object = t; };
  };
  CHECK(fault(with(transform::scale({1, 0, 1}))) == "/instances/1/transform");
  CHECK(fault(with(transform::rotate({1, 2, 3}, 40) * transform::scale({1, 0, 1}) *
                   transform::rotate({3, 1, 2}, 70))) == "/instances/1/transform");
  transform dependent;  // the third row is the sum of the first two, but for rounding
  dependent.row = {{{0.1, 0.2, 0.3, 0}, {0.7, 0.1, 0.9, 0}, {0.1 + 0.7, 0.2 + 0.1, 0.3 + 0.9, 0}}};
  CHECK(fault(with(dependent)) == "/instances/1/transform");
  CHECK(fault(with(transform::scale({1, not_a_number, 1}))) == "/instances/1/transform");
  for (double thin : {1e-6, 1e-12}) {
    scene s = good();
    with(transform::rotate({1, 2, 3}, 40) * transform::scale({1, thin, 1}))(s);
    CHECK_NOTHROW(validate(s, ""));
  }
}

TEST_CASE("instances: nothing is moved or shrunk out of reach") {
  const auto with = [](const transform& t) {
    return [t](scene& s) { s.instances[0].world_from_object = t; };
  };
  CHECK(fault(with(transform::translate({0, 2e18, 0}))) == "/instances/0/transform");
  CHECK(fault(with(transform::scale({1e-19, 1e-19, 1e-19}))) == "/instances/0/transform");
  CHECK(fault([&](scene& s) {
          s.meshes[0].positions[1].x = 1e10f;
          with(transform::scale({1e10, 1, 1}))(s);
        }) == "/instances/0/transform");
}

TEST_CASE("lights: finite, dimmed by at least 0, and pointing somewhere") {
  CHECK(fault([](scene& s) { s.lights[0].position.x = 1e300; }) == "/lights/0/position");
  CHECK(fault([](scene& s) { s.lights[0].quadratic = -1; }) == "/lights/0/attenuation");
  CHECK(fault([](scene& s) { s.lights[0].constant = not_a_number; }) == "/lights/0/attenuation");
  CHECK(fault([](scene& s) { s.lights[1].direction = {}; }) == "/lights/1/direction");
  CHECK(fault([](scene& s) { s.lights[1].direction.z = infinity; }) == "/lights/1/direction");
  CHECK(fault([](scene& s) { s.lights.resize(1025); }) == "/lights");
}

TEST_CASE("the camera's faults carry the scene's file") {
  CHECK(fault([](scene& s) { s.view.look_at = s.view.position; }) == "/camera/look_at");
  CHECK(fault([](scene& s) { s.view.position.x = 2e18; }) == "/camera/position");
  CHECK(fault([](scene& s) { s.view.up.x = not_a_number; }) == "/camera/up");
  CHECK(fault([](scene& s) { s.view.vertical_fov = 180; }) == "/camera/vertical_fov");
}
