// The block-size study on a picture of a few pixels: what it keeps, marks and refuses.
#include "study/sweep.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "scene/schema_helper.hpp"
#include "study/fingerprint.hpp"
#include "study/sweep_json.hpp"
#include "tracer/device_helper.hpp"
#include "tracer/scenes_helper.hpp"

using namespace facet;
using study::experiment;
using study::shape;
using study::standing;

namespace {

const scene& small() {
  static const scene s = [] {
    // Few features, so that drivers that compile for each shape do so fast.
    scene made = test::one_mesh(generate("torus_knot", {{"segments", 24}, {"sides", 5}}));
    made.name = "small";
    return made;
  }();
  return s;
}

std::vector<experiment> with_tree() {
  return {{"tree", &small(), tracer::tree_kind::levels, 24, 16, 2}};
}

std::vector<experiment> both() {
  return {{"no-tree", &small(), tracer::tree_kind::none, 16, 12, 2}, with_tree()[0]};
}

study::sweep_settings settings(std::vector<shape> shapes) {
  study::sweep_settings s;
  s.shapes = std::move(shapes);
  s.repeats = 3;
  s.serial_repeats = 2;
  s.seed = 5;
  return s;
}

study::sweep_result swept(const study::sweep_settings& s,
                          const std::vector<experiment>& e = with_tree()) {
  study::sweep_result r;
  study::run_sweep(test::queue(), e, s, r);
  return r;
}

/// What the published schema has against the file of this result; "" if nothing.
std::string fault_of(const study::sweep_result& r) {
  const auto schema =
      nlohmann::json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-sweep.schema.json"));
  return test::schema_fault(nlohmann::json::parse(study::to_json(r)), schema);
}

}  // namespace

TEST_CASE("each shape, the driver's and the serial reference are timed as often as asked") {
  const auto s = settings({{1, 1}, {8, 2}, {}});
  const study::sweep_result r = swept(s, both());
  CHECK(r.complete);
  CHECK(r.has_samples());
  CHECK(r.differences().empty());
  CHECK(r.from.device->name == test::device().name());
  REQUIRE(r.experiments.size() == 2);
  for (const study::experiment_result& e : r.experiments) {
    CAPTURE(e.name);
    CHECK(e.complete);
    REQUIRE(e.shapes.size() == 3);
    for (const study::shape_result& k : e.shapes) {
      CHECK(k.state == standing::measured);
      CHECK(k.kernel.ms.size() == 3);
      CHECK(k.wall.ms.size() == 3);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(k.kernel.ms[i] > 0);
        CHECK(k.wall.ms[i] > 0);
      }
      CHECK(k.warm_up_ms > 0);
      CHECK(k.kernel.range.low <= k.kernel.values.median);
      CHECK(k.kernel.values.median <= k.kernel.range.high);
      CHECK(k.by_wall.value == e.serial.wall.values.median / k.wall.values.median);
    }
    CHECK(e.serial.wall.ms.size() == 2);
    // Two of 192 and 384 pixels would be 1% and 0.5%: an edge may tip one, not several.
    CHECK(e.serial.pixels_off <= 1);
    for (std::uint32_t which = 0; which < 4; ++which)
      CHECK(std::count(e.order.begin(), e.order.end(), which) == (which == 3 ? 2 : 3));
    CHECK(!e.best.empty());
    CHECK(e.scene_hash == study::fingerprint_of(small()));
    CHECK(e.group_items >= 1);
  }
  CHECK(r.experiments[0].tree == "none");
  CHECK(r.experiments[0].tree_nodes == 0);
  CHECK(r.experiments[1].tree_nodes > 0);
  // One text, compiled with and without a tree.
  CHECK(r.experiments[0].text_hash == r.experiments[1].text_hash);
  CHECK(r.experiments[0].kernel_hash != r.experiments[1].kernel_hash);
  CHECK(fault_of(r) == "");
}

TEST_CASE("the order is random, and the seed's alone") {
  auto s = settings({{1, 1}, {8, 2}, {}});
  s.repeats = 10;
  const auto order = swept(s).experiments[0].order;
  CHECK(swept(s).experiments[0].order == order);
  s.seed = 6;
  CHECK(swept(s).experiments[0].order != order);
  CHECK(!std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("a shape that the device refuses says why; the others are measured") {
  const study::sweep_result r = swept(settings({{32768, 2}, {8, 2}}));
  CHECK(r.complete);
  const study::experiment_result& e = r.experiments[0];
  CHECK(e.shapes[0].state == standing::refused);
  CHECK(e.shapes[0].reason.find("32768x2") != std::string::npos);
  CHECK(e.shapes[0].kernel.ms.empty());
  CHECK(e.shapes[1].state == standing::measured);
  CHECK(e.best == std::vector<std::uint32_t>{1});
  CHECK(r.differences().empty());
  CHECK(fault_of(r) == "");
}

// One bit of one pixel, in work-groups of 8x2 alone.
TEST_CASE("a kernel that is wrong by one bit in one shape is caught, and its times do not count") {
  auto s = settings({{1, 1}, {8, 2}, {2, 8}});
  s.tracer.edits = {{"render.cl", "pixels[(size_t)y * view->width + x] = sum / (float)(n * n);",
                     "sum = sum / (float)(n * n);\n"
                     "  if (get_local_size(0) == 8 && get_local_size(1) == 2 && x == 5 && y == 3)\n"
                     "    sum.y = as_float(as_uint(sum.y) ^ 1u);\n"
                     "  pixels[(size_t)y * view->width + x] = sum;"}};
  const study::sweep_result r = swept(s);
  CHECK(r.complete);
  const study::experiment_result& e = r.experiments[0];
  CHECK(e.shapes[0].state == standing::measured);
  CHECK(e.shapes[2].state == standing::measured);
  const study::shape_result& wrong = e.shapes[1];
  CHECK(wrong.state == standing::different);
  CHECK(wrong.differs == 1);
  CHECK(wrong.differs_x == 5);
  CHECK(wrong.differs_y == 3);
  CHECK(wrong.by_kernel.value == 0);
  CHECK(std::count(e.best.begin(), e.best.end(), 1u) == 0);
  CHECK(r.differences() == std::vector<std::string>{"experiment tree, shape 8x2: 1 of 384 pixels "
                                                    "differ from 1x1's, the first at (5, 3)"});
  CHECK(fault_of(r) == "");

  // Where it is the first shape that is wrong, all others differ from it.
  s.shapes = {{8, 2}, {1, 1}, {2, 8}};
  CHECK(swept(s).differences().size() == 2);
}

TEST_CASE("interrupted, it keeps what it has and says that it is not complete") {
  const auto s = settings({{1, 1}, {8, 2}});
  study::sweep_result r;
  std::atomic<bool> stop = false;
  // Told of twice while two shapes warm up: the fifth time is after the third sample.
  int told = 0;
  study::run_sweep(
      test::queue(), both(), s, r,
      [&](std::uint64_t spent_ms, std::uint64_t expected_ms) {
        CHECK(spent_ms <= expected_ms);
        stop = ++told >= 5;
      },
      &stop);
  CHECK(!r.complete);
  CHECK(r.has_samples());
  REQUIRE(r.experiments.size() == 1);
  const study::experiment_result& e = r.experiments[0];
  CHECK(!e.complete);
  CHECK(e.order.size() == 3);
  CHECK(e.shapes[0].kernel.ms.size() + e.shapes[1].kernel.ms.size() + e.serial.wall.ms.size() == 3);
  CHECK(e.best.empty());
  CHECK(fault_of(r) == "");
}

TEST_CASE("interrupted while warming up there is nothing to keep") {
  study::sweep_result r;
  std::atomic<bool> stop = true;
  study::run_sweep(test::queue(), with_tree(), settings({{1, 1}}), r, {}, &stop);
  CHECK(!r.has_samples());
  CHECK(!r.complete);
}

TEST_CASE("what the device throws gets through, and what was measured before is kept") {
  // The second experiment's picture is larger than any may be.
  std::vector<experiment> e{with_tree()[0], with_tree()[0]};
  e[1].width = 100000;
  study::sweep_result r;
  CHECK_THROWS(study::run_sweep(test::queue(), e, settings({{1, 1}}), r));
  CHECK(!r.complete);
  REQUIRE(r.experiments.size() == 2);
  CHECK(r.experiments[0].complete);
  CHECK(r.experiments[0].shapes[0].kernel.ms.size() == 3);
  CHECK(!r.experiments[1].complete);
}

TEST_CASE("without the serial reference there are times and no speed-ups") {
  auto s = settings({{1, 1}});
  s.serial_repeats = 0;
  const study::sweep_result r = swept(s);
  CHECK(r.complete);
  CHECK(r.experiments[0].serial.wall.ms.empty());
  CHECK(r.experiments[0].shapes[0].by_kernel.value == 0);
  CHECK(fault_of(r) == "");
}
