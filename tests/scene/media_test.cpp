// The transparent objects that a point lies in.
#include <doctest/doctest.h>

#include <cmath>

#include "sanitized.hpp"
#include "scene/error.hpp"
#include "scene/generate.hpp"
#include "scene/media.hpp"

using namespace facet;

namespace {

material glass(const char* name) {
  material m;
  m.name = name;
  m.Kt = {0.9f, 0.9f, 0.9f};
  return m;
}

/// A glass ball of radius 2 around one of radius 1, and an opaque box over both.
scene balls() {
  scene s;
  s.materials = {material{}, glass("outer"), glass("inner")};
  s.meshes = {generate("icosphere", {{"radius", 1}, {"subdivisions", 2}}),
              generate("box", {{"size", 10}})};
  s.instances = {{1, {}, 0},
                 {0, transform::scale({1, 1, 1}), 2},
                 {0, transform::rotate({1, 2, 3}, 50) * transform::scale({2, 2, -2}), 1}};
  return s;
}

}  // namespace

TEST_CASE("a closed surface winds once around what is inside it, and not around what is outside") {
  const mesh m = generate("torus_knot", {});
  std::size_t inside = 0, outside = 0;
  // The sum of n angles, each within a few 2^-53 of 4 pi: far below 1e-9.
  const std::size_t tried = test::fewer(std::uint32_t(m.triangle_count() / 7));
  for (std::size_t k = 0; k < tried; ++k) {
    const std::size_t t = 7 * k;
    const vec3d a(m.position(t, 0)), b(m.position(t, 1)), c(m.position(t, 2));
    const vec3d middle = (a + b + c) / 3.0, n = cross(b - a, c - a);
    const vec3d step = n * (0.01 * std::sqrt(length(n)) / length(n));
    inside += std::abs(winding_numbers(m, 1, middle - step)[0] - 1) < 1e-9;
    outside += std::abs(winding_numbers(m, 1, middle + step)[0]) < 1e-9;
  }
  CHECK(inside == tried);
  CHECK(outside == tried);
}

TEST_CASE("media are listed from the innermost, mirrored ones too; opaque objects are none") {
  const scene s = balls();
  CHECK(media_at(s, {0.1, 0.2, 0.3}) == std::vector<std::uint32_t>{2, 1});
  CHECK(media_at(s, {1.5, 0, 0}) == std::vector<std::uint32_t>{1});
  CHECK(media_at(s, {4, 4, 4}).empty());
  // In the box of the outer ball, and beside it.
  CHECK(media_at(s, {1.9, 1.9, 1.9}).empty());
}

TEST_CASE("each material of a mesh is an object of its own") {
  scene s = balls();
  mesh both = s.meshes[0];
  const std::size_t n = both.triangle_count();
  for (std::size_t i = 0; i < 3 * n; ++i) both.indices.push_back(both.indices[i]);
  for (std::size_t i = 3 * n; i < 6 * n; ++i) {
    both.positions.push_back(both.positions[both.indices[i]] * 3.0f);
    both.indices[i] = std::uint32_t(both.positions.size() - 1);
  }
  both.normals.clear(), both.normal_indices.clear();
  both.materials.assign(n, 1);
  both.materials.resize(2 * n, 0);
  s.meshes = {both};
  s.instances = {{0, {}, instance::own_materials}};
  CHECK(media_at(s, {0, 0, 0}) == std::vector<std::uint32_t>{1});
  CHECK(media_at(s, {2, 0, 0}).empty());
  s.materials[0].Kt = {0.5f, 0.5f, 0.5f};
  CHECK(media_at(s, {2, 0, 0}) == std::vector<std::uint32_t>{0});
}

TEST_CASE("a camera in more media than the scene allows for is refused by their names") {
  scene s = balls();
  s.view.position = {0, 0, 0};
  const auto media = media_at(s, s.view.position);
  CHECK_THROWS_WITH_AS(check_camera_media(s, media), doctest::Contains("inner, outer"),
                       scene_error);
  s.nesting = 2;
  CHECK_NOTHROW(check_camera_media(s, media));
}
