// What follows from raw times, with times that are made up.
#include "study/sweep_result.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "study/sweep_json.hpp"

using namespace facet::study;

namespace {

shape_result measured(shape of, std::vector<double> kernel_ms) {
  shape_result s;
  s.of = of;
  s.state = standing::measured;
  for (double ms : kernel_ms) s.wall.ms.push_back(2 * ms);
  s.kernel.ms = std::move(kernel_ms);
  return s;
}

/// 2x2 is fastest, 4x4 cannot be told from it, 1x1 can.
experiment_result three_shapes() {
  experiment_result e;
  e.name = "tree";
  e.complete = true;
  e.serial.wall.ms = {30, 40, 50};
  e.shapes = {measured({1, 1}, {20, 21, 22}), measured({2, 2}, {9, 10, 11}),
              measured({4, 4}, {10.5, 11, 13})};
  return e;
}

}  // namespace

TEST_CASE("summaries, intervals and speed-ups follow from the samples") {
  experiment_result e = three_shapes();
  conclude(e, {});
  CHECK(e.serial.wall.values.median == 40);
  CHECK(e.serial.wall.range == interval{30, 50});  // of three values the ends: statistics_test
  const shape_result& s = e.shapes[1];
  CHECK(s.kernel.values.mean == 10);
  CHECK(s.kernel.values.deviation == 1);
  CHECK(s.kernel.range == interval{9, 11});
  CHECK(s.by_kernel.value == 4);
  CHECK(s.by_wall.value == 2);
  CHECK(s.by_kernel.range.low >= 30.0 / 11);
  CHECK(s.by_kernel.range.low < 4);
  CHECK(s.by_kernel.range.high > 4);
  CHECK(s.by_kernel.range.high <= 50.0 / 9);
}

TEST_CASE("the best are those whose intervals overlap, if all was measured") {
  experiment_result e = three_shapes();
  conclude(e, {});
  CHECK(e.best == std::vector<std::uint32_t>{1, 2});
  e.complete = false;
  conclude(e, {});
  CHECK(e.best.empty());
}

TEST_CASE("a shape with another picture, or refused, is never among the best") {
  experiment_result e = three_shapes();
  e.shapes[1].state = standing::different;
  e.shapes[2].state = standing::refused;
  conclude(e, {});
  CHECK(e.best == std::vector<std::uint32_t>{0});
  CHECK(e.shapes[1].by_kernel.value == 0);
}

TEST_CASE("the file holds every sample, in order, and null for what has no value") {
  sweep_result r;
  r.from.date = "2026-01-31T23:59:59Z";
  r.settings.shapes = {{1, 1}, {2, 2}, {4, 4}};
  r.experiments = {three_shapes()};
  experiment_result& e = r.experiments[0];
  e.order = {1, 3, 0, 2, 1};
  e.shapes[2].state = standing::refused;
  e.shapes[2].reason = "too large";
  e.shapes[0].wall.ms.clear();
  conclude(e, r.settings);
  const auto file = nlohmann::json::parse(to_json(r));
  CHECK(file["format"] == "facet-sweep");
  CHECK(file["version"] == 1);
  CHECK(file["complete"] == false);
  CHECK(file["date"] == "2026-01-31T23:59:59Z");
  const auto& found = file["experiments"][0];
  CHECK(found["order"] == nlohmann::json({"2x2", "serial", "1x1", "4x4", "2x2"}));
  CHECK(found["best"] == nlohmann::json({"2x2"}));
  CHECK(found["shapes"][1]["kernel"]["samples_ms"] == nlohmann::json({9.0, 10.0, 11.0}));
  CHECK(found["shapes"][1]["kernel"]["summary"]["interval_ms"] == nlohmann::json({9.0, 11.0}));
  CHECK(found["shapes"][1]["speed_up"]["kernel"]["value"] == 4.0);
  CHECK(found["shapes"][0]["wall"]["summary"].is_null());
  CHECK(found["shapes"][0]["speed_up"]["wall"].is_null());
  CHECK(found["shapes"][2]["standing"] == "refused");
  CHECK(found["shapes"][2]["reason"] == "too large");
  CHECK(!found["shapes"][2].contains("kernel"));
}
