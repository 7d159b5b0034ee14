// Visits that kernels count against those of a search by hand.
#include "study/visits.hpp"

#include <doctest/doctest.h>

#include "tracer/device_helper.hpp"
#include "tracer/layout.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using tracer::device_scene;
using tracer::layout_kind;
using tracer::options;
using tracer::ray;

namespace {

/// `count` triangles of one size, one behind the other along z, facing the ray below.
scene row_of(std::uint32_t count) {
  mesh m;
  for (std::uint32_t k = 0; k < count; ++k) {
    const float z = float(k);
    for (const vec3f p : {vec3f{-1, -1, z}, vec3f{1, -1, z}, vec3f{0, 1, z}})
      m.positions.push_back(p);
    m.indices.insert(m.indices.end(), {3 * k, 3 * k + 1, 3 * k + 2});
  }
  return test::one_mesh(std::move(m));
}

constexpr ray along{{0, 0, -1}, 0, {0, 0, 1}, INFINITY}, beside{{9, 9, -1}, 0, {0, 0, 1}, INFINITY};

std::vector<study::visits> counted(const scene& s, options o, std::vector<ray> rays, bool any) {
  device_scene on(test::queue(), s, study::counting_visits(std::move(o)));
  return study::count_visits(on, rays, any);
}

}  // namespace

TEST_CASE("without a tree each triangle is a visit, until any hit is one too many") {
  options o;
  o.tree = tracer::tree_kind::none;
  o.layout = layout_kind::narrow;
  const auto all = counted(row_of(9), o, {along, beside}, false);
  for (const study::visits& v : all) CHECK((v.triangles == 9 && v.nodes == 0));
  CHECK(counted(row_of(9), o, {along}, true)[0].triangles == 1);
}

TEST_CASE(
    "a ray beside everything visits the root; one along a row, the way to its first triangle") {
  for (const layout_kind layout : {layout_kind::narrow, layout_kind::wide}) {
    options o;
    o.layout = layout;
    const std::uint32_t n = 1024;
    const auto v = counted(row_of(n), o, {along, beside}, false);
    CHECK(v[1].nodes == 1);
    CHECK(v[1].triangles == 0);
    // Halves of halves of the row, or eighths of eighths: nothing behind the first hit is opened. A
    // leaf holds 4 triangles at most, or a block of 8.
    const std::uint32_t depth = layout == layout_kind::narrow ? 10 : 4;
    CHECK(v[0].nodes <= 2 * depth);
    CHECK(v[0].nodes >= (layout == layout_kind::narrow ? 8 : 3));
    CHECK(v[0].triangles >= 1);
    CHECK(v[0].triangles <= 4);
  }
}

TEST_CASE("a visit's bytes are those of the layout") {
  CHECK(study::visit_bytes_of("narrow").node == 64);
  CHECK(study::visit_bytes_of("narrow").triangle == 48);
  CHECK(study::visit_bytes_of("wide").node == 256);
  CHECK(study::visit_bytes_of("wide").triangle == 288);
}
