// A scene that has moved on a device, against one that is made anew from where it is now.
#include <doctest/doctest.h>

#include <limits>

#include "sanitized.hpp"
#include "scene/error.hpp"
#include "tracer/moving_helper.hpp"

using namespace facet;
using namespace facet::tracer;
using test::differing_hits;

namespace {

std::vector<transform> transforms_of(const scene& s) {
  std::vector<transform> all;
  for (const instance& i : s.instances) all.push_back(i.world_from_object);
  return all;
}

/// Rotated, stretched and, each third, mirrored.
void scatter(scene& s, std::uint64_t seed) {
  test::random r(seed);
  for (std::size_t k = 0; k < s.instances.size(); ++k) {
    const double size = k % 5 == 0 ? 1e-2 : 0.2 + r.uniform();
    s.instances[k].world_from_object =
        transform::translate(vec3d(r.in_cube() * 3.0f)) *
        transform::rotate(vec3d(r.in_cube()), 360.0 * r.uniform()) *
        transform::scale({size, size * 0.5, k % 3 == 0 ? -size : size});
  }
}

void jitter(scene& s, std::uint32_t mesh, std::uint64_t seed) {
  test::random r(seed);
  for (vec3f& p : s.meshes[mesh].positions) p = p + r.in_cube() * 0.1f;
  for (vec3f& n : s.meshes[mesh].normals) n = normalize(n + r.in_cube() * 0.3f);
}

void move(device_scene& d, const scene& s, std::uint32_t mesh) {
  d.move_vertices(mesh, s.meshes[mesh].positions, s.meshes[mesh].normals);
}

options movable() {
  options o;
  o.movable = true;
  return o;
}

/// The message of what is thrown.
template <class Error, class F>
std::string message_of(F f) {
  try {
    f();
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE(
    "moved vertices give the hits of a scene made anew, one mesh after the other" *
    doctest::skip(test::is_sanitized)) {  // minutes; the next one has moves for the sanitizers
  // Closed, and many more triangles without an area than are listed; apart from each other.
  for (const mesh& m : {generate("icosphere", {{"subdivisions", 4}}), test::random_soup(300, 4)})
    for (const test::way& w : test::ways_to_move()) {
      CAPTURE(w.name);
      scene s = test::one_mesh(m);
      if (w.options.tree == tree_kind::none && m.triangle_count() > 1000)
        s = test::one_mesh(generate("icosphere", {{"subdivisions", 2}}));
      device_scene moved(test::queue(), s, w.options);
      const std::vector<vec3f> first = s.meshes[0].positions;
      for (const test::deformation& d : test::deformations()) {
        CAPTURE(d.name);
        s.meshes[0].positions = d.apply(first);
        move(moved, s, 0);
        CHECK(differing_hits(moved, s, w.options, 5) == 0);
      }
    }
}

TEST_CASE("many moves of meshes and of instances, in turns, keep hits and pictures as they are") {
  for (const test::way& w : test::ways_to_move()) {
    CAPTURE(w.name);
    scene s = test::many_instances();
    device_scene moved(test::queue(), s, w.options);
    for (std::uint32_t k = 0; k < (test::is_sanitized ? 3 : 6); ++k) {
      CAPTURE(k);
      if (k % 3 != 1) jitter(s, k % 2, k), move(moved, s, k % 2);
      if (k % 3 != 0) scatter(s, k), moved.place(transforms_of(s));
      CHECK(differing_hits(moved, s, w.options, k) == 0);
    }
    device_scene anew(test::queue(), s, w.options);
    CHECK(test::same_picture(moved, anew, s));
  }
}

TEST_CASE("a moved picture has every feature, and the camera may come to lie in glass") {
  for (const test::way& w : test::ways_to_move()) {
    CAPTURE(w.name);
    scene s = test::every_feature();
    device_scene moved(test::queue(), s, w.options);
    device_scene as_before(test::queue(), s, w.options);
    CHECK(test::same_picture(moved, as_before, s));
    for (vec3f& p : s.meshes[0].positions) p = p * 12.0f;
    move(moved, s, 0);
    {
      device_scene anew(test::queue(), s, w.options);
      CHECK(test::same_picture(moved, anew, s));
    }
    CHECK_FALSE(test::same_picture(moved, as_before, s));
    scatter(s, 8);
    moved.place(transforms_of(s));
    device_scene anew(test::queue(), s, w.options);
    CHECK(test::same_picture(moved, anew, s));
  }
}

TEST_CASE(
    "an only instance may leave the identity, for which kernels are compiled, and come back") {
  for (const test::way& w : test::ways_to_move()) {
    CAPTURE(w.name);
    scene s = test::one_mesh(test::random_soup(100, 9));
    device_scene moved(test::queue(), s, w.options);
    const auto hits_of = [&] { return differing_hits(moved, s, w.options, 2); };
    CHECK(hits_of() == 0);
    moved.place(transforms_of(s));
    CHECK(moved.prepared().features == "none");
    scatter(s, 4);
    moved.place(transforms_of(s));
    CHECK(moved.prepared().features == "instances");
    CHECK(hits_of() == 0);
    jitter(s, 0, 3), move(moved, s, 0);
    CHECK(hits_of() == 0);
    s.instances[0].world_from_object = {};
    moved.place(transforms_of(s));
    CHECK(hits_of() == 0);
  }
}

TEST_CASE("positions that no triangle uses, and a mesh that nothing shows, may move anywhere") {
  scene s = test::one_mesh(test::random_soup(50, 2));
  s.meshes.push_back(test::random_soup(20, 3));
  s.meshes[0].positions.push_back({0, 0, 0});
  device_scene moved(test::queue(), s, movable());
  s.meshes[0].positions.back() = {NAN, 0, 2e18f};
  jitter(s, 1, 2), move(moved, s, 1);
  move(moved, s, 0);
  CHECK(differing_hits(moved, s, movable(), 5) == 0);
}

TEST_CASE("normals stay if none are given") {
  scene s = test::many_instances();
  device_scene moved(test::queue(), s, movable());
  const std::vector<vec3f> normals = s.meshes[0].normals;
  jitter(s, 0, 5);
  s.meshes[0].normals = normals;
  moved.move_vertices(0, s.meshes[0].positions);
  device_scene anew(test::queue(), s, movable());
  CHECK(test::same_picture(moved, anew, s));
}

TEST_CASE("what cannot be moved is refused, and nothing has changed") {
  scene s = test::many_instances();
  device_scene d(test::queue(), s, movable());
  const mesh& m = s.meshes[0];
  const auto invalid = [&](auto f) { return message_of<runtime::exception>(f); };
  const auto refused = [&](auto f) { return message_of<scene_error>(f); };

  device_scene fixed(test::queue(), s);
  CHECK(has(invalid([&] { move(fixed, s, 0); }), "make it with options::movable"));
  CHECK(has(invalid([&] { fixed.place(transforms_of(s)); }), "make it with options::movable"));
  CHECK(has(invalid([&] { d.move_vertices(2, m.positions); }), "mesh 2 was to be moved"));
  CHECK(has(invalid([&] { d.move_vertices(1, m.positions); }),
            std::to_string(m.positions.size()) + " positions were given, and mesh 1 has 600"));
  CHECK(has(invalid([&] {
              d.move_vertices(0, m.positions, {m.normals.data(), 3});
            }),
            "3 normals were given"));
  CHECK(
      has(invalid([&] { d.move_vertices(1, s.meshes[1].positions, m.normals); }), "mesh 1 has 0"));

  for (const float bad : {NAN, INFINITY, 2e18f}) {
    std::vector<vec3f> positions = m.positions;
    positions[7].y = bad;
    CHECK(has(refused([&] { d.move_vertices(0, positions); }), "has a corner at"));
  }
  std::vector<vec3f> normals = m.normals;
  normals[3] = {0, 2, 0};
  CHECK(has(refused([&] { d.move_vertices(0, m.positions, normals); }), "is not of length 1"));
  CHECK(has(refused([&] {
              const std::vector<vec3f> far(m.positions.size(), vec3f(9e17f, 9e17f, 9e17f));
              d.move_vertices(0, far);
            }),
            "moves the mesh to the coordinate"));

  std::vector<transform> to = transforms_of(s);
  CHECK(has(invalid([&] { d.place({to.data(), 3}); }), "3 transforms were given"));
  to[0] = transform::translate({5, 0, 0});
  to[3] = transform::scale({1, 0, 1});
  CHECK(has(refused([&] { d.place(to); }), "/instances/3/transform: is singular"));
  to[3] = transform::translate({NAN, 0, 0});
  CHECK(has(refused([&] { d.place(to); }), "is not finite"));

  CHECK(differing_hits(d, s, movable(), 1) == 0);
  jitter(s, 0, 1), move(d, s, 0);
  CHECK(differing_hits(d, s, movable(), 1) == 0);
}

TEST_CASE("moving takes no more memory from the second time on") {
  for (const test::way& w : test::ways_to_move()) {
    CAPTURE(w.name);
    scene s = test::many_instances();
    device_scene moved(test::queue(), s, w.options);
    const auto in_use = [] { return test::queue().get_context().memory_in_use(); };
    std::uint64_t after_first = 0, bytes = 0;
    for (std::uint32_t k = 0; k < 12; ++k) {
      for (const std::uint32_t mesh : {0u, 1u}) jitter(s, mesh, k), move(moved, s, mesh);
      scatter(s, k), moved.place(transforms_of(s));
      if (k == 0) after_first = in_use(), bytes = moved.prepared().device_bytes;
      CHECK(in_use() == after_first);
      CHECK(moved.prepared().device_bytes == bytes);
    }
  }
}

// It compiles kernels above all, which has nothing for the sanitizers to watch and takes minutes
// with them.
TEST_CASE("a mistake in moving is seen by these tests" * doctest::skip(test::is_sanitized)) {
  const std::string refit = "refit_node(nodes, first_node + order[k], corners);";
  const std::vector<kernel_edit> mistakes{
      {"refit.cl", refit, "if (first_treelet == 0u) " + refit},
      {"refit.cl", refit, ";"},
      {"refit.cl", "k = starts[first_treelet + i];", "k = starts[first_treelet + i] + 1u;"},
      {"refit.cl", "n->x[0][c] = b.lo.x, n->x[1][c] = b.hi.x;", "n->x[0][c] = b.lo.x;"},
      {"refit.cl", "vload8(0, n->z[0])", "vload8(0, n->z[1])"},
      {"refit.cl", "side_bounds(n, 1u)", "side_bounds(n, 0u)"},
      {"moved_corners.cl", "c.p[2] = vload3(v.z, positions);", ""},
      {"moved_corners.cl", "if (has_shut != 0u || surely_has_area(c)) return;", "return;"},
  };
  for (const kernel_edit& e : mistakes) {
    CAPTURE(e.from);
    CAPTURE(e.to);
    std::size_t seen = 0;
    for (const test::way& w : test::ways_to_move()) {
      if (w.options.tree == tree_kind::none || w.options.geometry == geometry_kind::image) continue;
      scene s = test::one_mesh(generate("icosphere", {{"subdivisions", 4}}));
      options o = w.options;
      device_scene anew(test::queue(), s, o);
      o.edits = {e};
      device_scene moved(test::queue(), s, o);
      const std::vector<vec3f> first = s.meshes[0].positions;
      for (const char* name : {"jittered", "a line"})
        for (const test::deformation& d : test::deformations()) {
          if (d.name != name) continue;
          s.meshes[0].positions = d.apply(first);
          move(moved, s, 0);
          seen += differing_hits(moved, s, w.options, 5);
        }
    }
    CHECK(seen > 0);
  }
}
