#include "study/explain.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "runtime/runtime.hpp"
#include "scene/load.hpp"
#include "scene/placed.hpp"
#include "tracer/tracer.hpp"

using namespace facet;

namespace {

scene disc_on_black() {
  scene s;
  s.materials.emplace_back();
  s.materials[0].Ke = {1, 1, 1};
  mesh m;
  m.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  m.indices = {0, 1, 2, 0, 2, 3};
  s.meshes.push_back(m);
  s.instances.push_back({});
  return s;
}

/// Why the device's picture of one scene, so wide, is not the reference's of another.
study::explanation explained(const scene& expected, const scene& traced, std::uint32_t width) {
  const char* name = std::getenv("FACET_TEST_DEVICE");
  const runtime::queue q{runtime::select_device(name ? name : "0")};
  const std::uint32_t height = std::max(1u, width * expected.height / expected.width);
  const reference::tracer<float> oracle(expected);
  return study::explain(expected, oracle, oracle.render(width, height, expected.max_depth),
                        tracer::device_scene(q, traced).render(width, height, traced.max_depth),
                        expected.max_depth);
}

}  // namespace

TEST_CASE("equal pictures have nothing to explain") {
  const scene s = disc_on_black();
  const reference::tracer<double> oracle(s);
  const picture p = oracle.render(32, 32, 0);
  CHECK(study::explain(s, oracle, p, p, 0).off.empty());
}

TEST_CASE("a wrong pixel inside a surface, or NaN, is not explained; a silhouette's is") {
  const scene s = disc_on_black();
  const reference::tracer<double> oracle(s);
  const picture p = oracle.render(32, 32, 0);
  picture wrong = p;
  wrong.at(20, 15)[1] = 0.5f;
  wrong.at(10, 15)[0] = NAN;
  auto e = study::explain(s, oracle, p, wrong, 0);
  CHECK(e.off.size() == 2);
  CHECK(e.unexplained() == 2);

  // The square's side seen from 5 units at 40 degrees: a camera that puts it within 2^-6 of a
  // pixel's centre makes that pixel ambiguous.
  scene at_edge = s;
  const double half = std::tan(20 * 3.14159265358979 / 180) * 5;  // of the picture, in the plane
  const double centre = (16.5 / 16 - 1) * half;                   // of the pixel 16 of 32
  for (vec3f& v : at_edge.meshes[0].positions)
    v.x = float(v.x > 0 ? centre + half / 16 / 128 : v.x);
  const reference::tracer<double> edge_oracle(at_edge);
  const picture q = edge_oracle.render(32, 32, 0);
  picture tipped = q;
  tipped.at(16, 15)[0] = 1 - q.at(16, 15)[0];
  e = study::explain(at_edge, edge_oracle, q, tipped, 0);
  REQUIRE(e.off.size() == 1);
  CHECK(e.off[0].edge_within > 0);
  CHECK(e.off[0].edge_within <= 0x1p-5);
}

// The picture of every scene in scenes/, from the device and from the float reference.
TEST_CASE("every scene: at most 0.1% of the pixels are off by more than 1/255, each at an edge") {
  std::size_t scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(FACET_SOURCE_DIR "/scenes")) {
    const std::string path = file.path().string();
    if (file.path().extension() != ".json" || path.find("schema") != std::string::npos) continue;
    CAPTURE(path);
    ++scenes;
    const scene s = placed(load_scene(file.path()));
    const auto e = explained(s, s, 240);
    CHECK(e.off.size() * 1000 <= e.pixels);
    CHECK(e.unexplained() == 0);
  }
  CHECK(scenes >= 4);
}

// Corners that are rounded in the world move edges by about 2^-24 of the picture, as rays that are
// rounded do.
TEST_CASE("a scene's picture is that of its instances, but at edges") {
  for (const char* file : {"nested_glass.json", "showcase.json"}) {
    CAPTURE(file);
    const scene s = load_scene(std::filesystem::path(FACET_SOURCE_DIR "/scenes") / file);
    const scene moved = placed(s);
    REQUIRE(moved.instances.size() < s.instances.size());
    const auto e = explained(s, moved, 160);
    CHECK(e.off.size() * 1000 <= e.pixels);
    CHECK(e.unexplained() == 0);
  }
}
