#include "tracer/pack.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "scene/error.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using namespace facet::tracer;

TEST_CASE("meshes stand one after the other, three corners a triangle, materials beside them") {
  scene s = test::every_feature();
  s.meshes[1].materials.assign(s.meshes[1].triangle_count(), 2);
  const packed_scene p = pack(s, true);
  CHECK(p.world.triangle_count == s.triangle_count());
  CHECK(p.corners.size() == 3 * s.triangle_count());
  CHECK(p.normals.size() == p.corners.size());
  for (std::size_t k = 0; k < s.meshes.size(); ++k) {
    const packed_mesh& m = p.meshes[k];
    REQUIRE(m.triangle_count == s.meshes[k].triangle_count());
    for (std::uint32_t t : {0u, m.triangle_count - 1}) {
      const vec3f c = s.meshes[k].position(t, 2);
      CHECK(p.corners[3 * (m.first_triangle + t) + 2] == texel{c.x, c.y, c.z, 0});
      CHECK(p.triangle_materials[m.first_triangle + t] == s.meshes[k].material_of(t));
    }
  }
}

TEST_CASE("normals are packed only when asked for, and are 0 for flat meshes") {
  const scene s = test::every_feature();
  CHECK(pack(s, false).normals.empty());
  const packed_scene p = pack(s, true);
  CHECK(p.normals[3 * p.meshes[1].first_triangle] == texel{});
  const vec3f n = s.meshes[0].normal(0, 0);
  CHECK(p.normals[0] == texel{n.x, n.y, n.z, 0});
}

TEST_CASE("a mesh that no instance shows takes no room") {
  scene s = test::every_feature();
  s.meshes.push_back(generate("soup", {{"n", 1000}}));
  CHECK(pack(s, false).meshes.back().triangle_count == 0);
  CHECK(pack(s, false).world.triangle_count == s.triangle_count() - 1000);
}

TEST_CASE("an instance holds both maps, its world box and its mesh's reach") {
  scene s = test::one_mesh(generate("box", {{"size", 2}}));
  s.instances[0].world_from_object = transform::translate({10, 0, 0}) * transform::scale({2, 1, 1});
  const packed_scene p = pack(s, false);
  const Instance& i = p.instances[0];
  CHECK(i.world_from_object[3] == 10);
  CHECK(i.object_from_world[0] == 0.5f);
  CHECK(i.object_from_world[3] == -5);
  CHECK(i.reach[0] == 1);
  // The box [8, 12] grown by 2^-20 * (2 * 1 + 10).
  CHECK(i.lo[0] <= 8);
  CHECK(i.lo[0] > 8 - 2e-5f);
  CHECK(i.hi[0] >= 12);
  CHECK(p.world.reach[0] == i.hi[0]);
  CHECK(i.id == 0);
  CHECK(i.material == FACET_NONE);
}

TEST_CASE("transparent materials carry -ln Kt and sigma; opaque ones carry 0") {
  scene s = test::every_feature();
  const packed_scene p = pack(s, false);
  const Material& glass = p.materials[1];
  CHECK(glass.transparent == 1);
  CHECK(glass.minus_ln_Kt[1] == float(-std::log(double(0.7f))));
  CHECK(glass.sigma[2] == float(-std::log(double(0.5f)) / double(0.7f)));
  CHECK(p.materials[0].transparent == 0);
  CHECK(p.materials[0].sigma[0] == 0);
  s.materials[1].Kt = {1, 0, 0.5f};
  const Material red = pack(s, false).materials[1];
  CHECK(red.minus_ln_Kt[0] == 0);
  CHECK(red.minus_ln_Kt[1] == float(-std::log(1e-30)));
}

TEST_CASE("a directional light is packed as the unit way towards it") {
  const packed_scene p = pack(test::every_feature(), false);
  const Light& sun = p.lights[1];
  CHECK(sun.kind == FACET_DIRECTIONAL_LIGHT);
  CHECK(sun.position[1] == float(2 / std::sqrt(5.25)));
  CHECK(p.lights[0].kind == FACET_POINT_LIGHT);
}

TEST_CASE("a triangle without an area becomes a point and keeps its place") {
  mesh m;
  m.positions = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {0, 1, 0}};
  m.indices = {0, 1, 2, 0, 1, 3, 1, 1, 3};
  const packed_scene p = pack(test::one_mesh(m), false);
  CHECK(p.corners[2] == p.corners[0]);
  CHECK(p.corners[5] != p.corners[3]);
  CHECK(p.corners[8] == p.corners[6]);
  CHECK(p.world.triangle_count == 3);
}

TEST_CASE("a degenerate camera is refused") {
  scene s = test::one_mesh(generate("box", {}));
  s.view.look_at = s.view.position;
  CHECK_THROWS_AS(pack_view(s, {}, 10, 10, 1), scene_error);
}
