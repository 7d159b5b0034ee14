// The oracles themselves, on answers known by hand.
#include <doctest/doctest.h>

#include <cmath>

#include "study/cases/exact.hpp"
#include "study/cases/lab.hpp"

using namespace facet;
using namespace facet::study;

namespace {

const std::array<grid_point, 3> triangle{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
const std::array<vec3d, 3> same{vec3d(0, 0, 0), vec3d(4, 0, 0), vec3d(0, 4, 0)};

}  // namespace

TEST_CASE(
    "on the grid, edges and corners belong to a triangle, its plane and what is behind do not") {
  const grid_point down{0, 0, -1};
  CHECK(grid_ray_meets({1, 1, 5}, down, triangle));
  CHECK(grid_ray_meets({2, 2, 5}, down, triangle));  // on the long edge
  CHECK(grid_ray_meets({0, 0, 5}, down, triangle));  // at a corner
  CHECK(grid_ray_meets({1, 1, 0}, down, triangle));  // starts on it
  CHECK_FALSE(grid_ray_meets({3, 2, 5}, down, triangle));
  CHECK_FALSE(grid_ray_meets({1, 1, -1}, down, triangle));
  CHECK_FALSE(grid_ray_meets({-1, 1, 0}, {1, 0, 0}, triangle));  // in its plane
  CHECK(grid_ray_meets({1, 1, -5}, {0, 0, 1}, triangle));        // from its other side
}

TEST_CASE("the rationals find t, u and v, and how far from the edges") {
  const auto hit = meet_exactly({1, 2, 6}, {0, 0, -2}, same);
  REQUIRE(hit);
  CHECK(hit->t == 3);
  CHECK(hit->u == 0.25);
  CHECK(hit->v == 0.5);
  CHECK(hit->least_share == 0.25);
  CHECK(hit->is_inside);
  CHECK_FALSE(meet_exactly({2, 2, 6}, {0, 0, -1}, same)->is_inside);
  CHECK_FALSE(meet_exactly({3, 2, 6}, {0, 0, -1}, same));
  CHECK(meet_exactly({1, 1, -6}, {0, 0, -1}, same)->t == -6);
  // A third is no float: only the last rounding is left.
  CHECK(meet_exactly({1, 1, 1}, {0, 0, -3}, same)->t == 1.0 / 3);
  CHECK(plane_distance({9, 9, 6}, {0, 0, -2}, same) == 3);
  CHECK(std::isnan(plane_distance({9, 9, 6}, {1, 0, 0}, same)));
}

TEST_CASE("the filter and the rationals agree, next to an edge, too") {
  // One double above the long edge x + y = 4, and one below.
  const float beside = std::nextafter(2.0f, 3.0f), within = std::nextafter(2.0f, 1.0f);
  const std::array<vec3f, 3> p{vec3f(0, 0, 0), vec3f(4, 0, 0), vec3f(0, 4, 0)};
  CHECK(meets_exactly({2, 2, 1}, {0, 0, -1}, p));
  CHECK(meets_exactly({within, 2, 1}, {0, 0, -1}, p));
  CHECK_FALSE(meets_exactly({beside, 2, 1}, {0, 0, -1}, p));
  CHECK_FALSE(meets_exactly({1, 1, -1}, {0, 0, -1}, p));
}

TEST_CASE("each ray draws its own numbers, the same every time") {
  CHECK(draw(1, 5).bits() == draw(1, 5).bits());
  CHECK(draw(1, 5).bits() != draw(1, 6).bits());
  CHECK(draw(1, 5).bits() != draw(2, 5).bits());
  double sum = 0;
  for (std::uint64_t i = 0; i < 10000; ++i) {
    draw d(3, i);
    const double x = d.uniform();
    REQUIRE((x >= 0 && x < 1));
    sum += x;
    CHECK(std::abs(length(d.direction()) - 1) < 1e-15 * 4);
  }
  // The mean of 10^4 numbers of variance 1/12 lies within 5 of its deviations of 1/2.
  CHECK(std::abs(sum / 10000 - 0.5) < 5 * std::sqrt(1.0 / 12 / 10000));
}
