#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "scene/scene.hpp"
#include "scene/scratch_folder.hpp"

using facet::camera;
using facet::frame_of;
using facet::vec3d;
using facet::test::contains;
using facet::test::error_of;

namespace {

vec3d through(const facet::camera_frame& f, double x, double y) {
  return normalize(f.corner + f.dx * x + f.dy * y);
}

/// A dozen roundings of numbers below 4 in size.
constexpr double rounding = 12 * 4 * 0x1p-53;

}  // namespace

TEST_CASE("the middle of the picture is look_at, for even and odd sizes") {
  camera c;
  c.position = {1, 2, 3};
  c.look_at = {-4, 0.5, 1};
  for (std::uint32_t n : {1u, 2u, 7u, 640u}) {
    const auto f = frame_of(c, n, n + 1);
    CHECK(length(through(f, n / 2.0, (n + 1) / 2.0) - normalize(c.look_at - c.position)) <
          rounding);
    CHECK(f.origin == c.position);
  }
}

TEST_CASE("x grows to the right, y down, pixels are square") {
  const auto f = frame_of({}, 200, 100);
  CHECK(f.dx.x > 0);
  CHECK(f.dy.y < 0);
  CHECK(length(f.dx) == doctest::Approx(length(f.dy)).epsilon(1e-15));
  CHECK(f.dx.y == 0);
  CHECK(f.dx.z == 0);
}

TEST_CASE("the vertical angle is the camera's, at any width") {
  camera c;
  for (double fov : {1.0, 40.0, 90.0, 179.0}) {
    c.vertical_fov = fov;
    for (std::uint32_t width : {10u, 1000u}) {
      const auto f = frame_of(c, width, 100);
      const vec3d top = through(f, width / 2.0, 0), bottom = through(f, width / 2.0, 100);
      const double angle = std::atan2(length(cross(top, bottom)), dot(top, bottom));
      // At 179 degrees the directions' relative error is magnified by tan(89.5) = 115.
      CHECK(std::abs(angle * 180 / std::numbers::pi - fov) < 180 * 115 * rounding);
    }
  }
}

TEST_CASE("the length of up and the distance of look_at do not matter") {
  camera near, far;
  near.position = far.position = {0, 0, 0};
  near.look_at = {1e-200, 0, -1e-200};
  far.look_at = {1e17, 0, -1e17};
  near.up = {0, 1e-200, 0};
  far.up = {0, 1e200, 0};
  const auto a = frame_of(near, 30, 20), b = frame_of(far, 30, 20);
  CHECK(length(a.corner - b.corner) < rounding);
  CHECK(length(a.dx - b.dx) < rounding);
}

TEST_CASE("a degenerate camera is refused, with what to do") {
  camera c;
  c.look_at = c.position;
  CHECK(error_of([&] { frame_of(c, 8, 8); }).place() == "/camera/look_at");
  c = {};
  c.up = {0, 0, 3};
  CHECK(error_of([&] { frame_of(c, 8, 8); }).place() == "/camera/up");
  c.up = {0, 0, 0};
  CHECK(error_of([&] { frame_of(c, 8, 8); }).place() == "/camera/up");
  c.up = {0, 1e-10, 1};
  CHECK(contains(error_of([&] { frame_of(c, 8, 8); }).what(), "across the view"));
  for (double fov : {0.0, -1.0, 180.0, 1e300, std::nan("")}) {
    c = {};
    c.vertical_fov = fov;
    CHECK(error_of([&] { frame_of(c, 8, 8); }).place() == "/camera/vertical_fov");
  }
  c = {};
  c.look_at.x = INFINITY;
  CHECK(error_of([&] { frame_of(c, 8, 8); }).place() == "/camera/look_at");
  CHECK(error_of([&] { frame_of({}, 0, 8); }).place() == "/picture/width");
  CHECK(error_of([&] { frame_of({}, 8, 0); }).place() == "/picture/height");
}
