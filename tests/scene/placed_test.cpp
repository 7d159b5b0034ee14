// Scenes whose meshes are moved into the world.
#include "scene/placed.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/generate.hpp"
#include "scene/media.hpp"

using namespace facet;

namespace {

/// A flat box and a smooth ball, the ball twice: as it stands, and mirrored, stretched and of
/// another material.
scene three() {
  scene s;
  s.materials.resize(4);
  s.materials[2].Kt = s.materials[3].Kt = {0.9f, 0.9f, 0.9f};
  s.meshes = {generate("box", {{"size", 2}}),
              generate("icosphere", {{"radius", 1}, {"subdivisions", 2}, {"smooth", 1}})};
  s.meshes[0].materials.assign(s.meshes[0].triangle_count(), 1);
  s.instances = {{0, transform::translate({4, 0, 0})},
                 {1, {}, 2},
                 {1, transform::rotate({1, 2, 3}, 50) * transform::scale({2, 2, -4}), 3}};
  s.view.position = {0.1, 0.2, 0.1};
  return s;
}

/// Six times the volume that a part of a mesh's triangles encloses, positive where they turn
/// counter-clockwise seen from outside.
double volume(const mesh& m, std::size_t first, std::size_t count) {
  double sum = 0;
  for (std::size_t t = first; t < first + count; ++t)
    sum += dot(vec3d(m.position(t, 0)), cross(vec3d(m.position(t, 1)), vec3d(m.position(t, 2))));
  return sum;
}

bool is_untouched(const scene& s) {
  const scene p = placed(s);
  return p.meshes.size() == s.meshes.size() && p.instances.size() == s.instances.size() &&
         !p.around_camera;
}

}  // namespace

TEST_CASE("instances become one mesh at rest, triangle by triangle in their order") {
  const scene s = three(), p = placed(s);
  REQUIRE(p.meshes.size() == 1);
  REQUIRE(p.instances.size() == 1);
  CHECK(p.instances[0].world_from_object.is_identity());
  CHECK(p.instances[0].material == instance::own_materials);
  const mesh& m = p.meshes[0];
  REQUIRE(m.triangle_count() == s.placed_triangle_count());
  std::size_t at = 0, wrong_corners = 0, wrong_materials = 0, wrong_normals = 0;
  for (const instance& i : s.instances) {
    const mesh& from = s.meshes[i.mesh];
    const bool is_turned = i.world_from_object.determinant() < 0;
    for (std::size_t t = 0; t < from.triangle_count(); ++t, ++at) {
      for (const int c : {0, 1, 2}) {
        const int k = is_turned && c > 0 ? 3 - c : c;
        wrong_corners +=
            m.position(at, c) != vec3f(i.world_from_object.point(vec3d(from.position(t, k))));
        const vec3f n = m.normal(at, c);
        if (!from.is_smooth()) {
          wrong_normals += n != vec3f();
          continue;
        }
        // Across the surface's image: a ball's normals are its corners, of which tangents are
        // mapped. The mapped tangent and the unit normal are each off by a few 2^-24.
        const vec3d along = cross(vec3d(from.normal(t, k)), vec3d{0.3, 0.5, 0.8});
        const vec3d mapped = i.world_from_object.vector(along);
        wrong_normals += std::abs(dot(mapped, vec3d(n))) > 0x1p-20 * length(mapped);
        wrong_normals += std::abs(length(vec3d(n)) - 1) > 0x1p-22;
        wrong_normals += !(dot(vec3d(n), vec3d(m.position(at, c))) > 0);
      }
      wrong_materials += m.material_of(at) !=
                         (i.material == instance::own_materials ? from.material_of(t) : i.material);
    }
  }
  CHECK(wrong_corners == 0);
  CHECK(wrong_materials == 0);
  CHECK(wrong_normals == 0);
}

TEST_CASE("what is mirrored stays closed with its front outside") {
  const scene s = three(), p = placed(s);
  const std::size_t boxes = s.meshes[0].triangle_count(), balls = s.meshes[1].triangle_count();
  const double ball = volume(s.meshes[1], 0, balls);
  CHECK(ball > 0);
  // Corners that are rounded at sizes up to 4 move a volume by far less than a part in 10^5.
  CHECK(volume(p.meshes[0], boxes + balls, balls) == doctest::Approx(16 * ball).epsilon(1e-5));
}

TEST_CASE("the camera stays within what it was in, the innermost first") {
  const scene s = three();
  REQUIRE(media_at(s, s.view.position) == std::vector<std::uint32_t>{2, 3});
  CHECK(media_around_camera(placed(s)) == std::vector<std::uint32_t>{2, 3});
}

TEST_CASE("a scene of flat meshes stays without normals") {
  scene s = three();
  s.instances.resize(1);
  CHECK(!placed(s).meshes[0].is_smooth());
}

TEST_CASE(
    "scenes stay as they are that have one mesh at rest, nothing, many copies, or something far "
    "away") {
  scene s = three();
  s.instances = {{1, {}}};
  CHECK(is_untouched(s));
  s.instances.clear();
  CHECK(is_untouched(s));

  // 320 triangles a ball: 2^20 / 320 = 3,276.8.
  s = three();
  s.instances.assign(3276, {1, transform::scale({2, 2, 2})});
  CHECK(!is_untouched(s));
  s.instances.assign(3277, {1, transform::scale({2, 2, 2})});
  CHECK(is_untouched(s));

  for (const double away : {100.0, 200.0}) {
    s = three();
    s.instances[1].world_from_object = transform::translate({0, away, 0});  // of size 2
    CHECK(is_untouched(s) == (away == 200));
  }
  s = three();
  s.instances[0].world_from_object = transform::scale({2e18, 2e18, 2e18});
  CHECK(is_untouched(s));
}
