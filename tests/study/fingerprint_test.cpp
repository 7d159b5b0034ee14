#include "study/fingerprint.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <iterator>
#include <set>

#include "tracer/scenes_helper.hpp"

using namespace facet;
using study::fingerprint_of;

TEST_CASE("texts have the hashes that FNV-1a's authors publish") {
  CHECK(fingerprint_of(std::string()) == "fnv1a64:cbf29ce484222325");
  CHECK(fingerprint_of(std::string("a")) == "fnv1a64:af63dc4c8601ec8c");
  CHECK(fingerprint_of(std::string("foobar")) == "fnv1a64:85944171f73967e8");
}

TEST_CASE("what decides a picture decides the scene's fingerprint, down to one bit") {
  const std::function<void(scene&)> changes[] = {
      [](scene& s) { s.view.position.x = std::nextafter(s.view.position.x, 9); },
      [](scene& s) {
        s.view.up = {1, 1, 0};
      },
      [](scene& s) { s.samples = 2; },
      [](scene& s) { s.ambient.z += 0.1f; },
      [](scene& s) { s.background_alpha = 0.5f; },
      [](scene& s) { s.materials[1].Ni += 0.1f; },
      [](scene& s) { s.materials[1].has_attenuation = true; },
      [](scene& s) {
        s.meshes[0].positions[7].y = std::nextafter(s.meshes[0].positions[7].y, 9.0f);
      },
      [](scene& s) { std::swap(s.meshes[0].indices[0], s.meshes[0].indices[3]); },
      [](scene& s) { s.meshes[0].normals[3].x *= -1; },
      [](scene& s) { s.meshes[1].materials.assign(s.meshes[1].triangle_count(), 1); },
      [](scene& s) { s.instances[1].material = 2; },
      [](scene& s) { s.instances[1].world_from_object.row[0][3] += 0x1p-40; },
      [](scene& s) { s.instances.pop_back(); },
      [](scene& s) { s.lights[0].quadratic = 0.01f; },
      [](scene& s) { s.lights[0].type = light::kind::directional; },
  };
  std::set<std::string> found{fingerprint_of(test::every_feature())};
  for (const auto& change : changes) {
    scene s = test::every_feature();
    change(s);
    found.insert(fingerprint_of(s));
  }
  CHECK(found.size() == 1 + std::size(changes));
}

TEST_CASE("names, notes and the picture's own size do not") {
  scene s = test::every_feature();
  const std::string before = fingerprint_of(s);
  s.name = "another";
  s.materials[0].name = "another";
  s.meshes[0].name = "another";
  s.notes.push_back("another");
  s.width = 1, s.height = 1, s.max_depth = 0;
  CHECK(fingerprint_of(s) == before);
}

TEST_CASE("a kernel's fingerprint depends on text and options, and on where one ends") {
  const std::set<std::string> found{fingerprint_of(tracer::kernel_description{"ab", "c", 1}),
                                    fingerprint_of(tracer::kernel_description{"a", "bc", 1}),
                                    fingerprint_of(tracer::kernel_description{"ab", "d", 1}),
                                    fingerprint_of(tracer::kernel_description{"abc", "", 1})};
  CHECK(found.size() == 4);
}
