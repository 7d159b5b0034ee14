#include "scene/framing.hpp"

#include <doctest/doctest.h>

#include <cmath>

using facet::box3d;
using facet::camera;
using facet::vec3d;

namespace {

/// Do all corners of the box fall into the picture of a camera?
bool sees(const camera& c, const box3d& box, std::uint32_t width, std::uint32_t height) {
  const auto f = frame_of(c, width, height);
  const vec3d forward = normalize(c.look_at - c.position);
  for (int corner = 0; corner < 8; ++corner) {
    const vec3d p(corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                  corner & 4 ? box.hi.z : box.lo.z);
    const vec3d v = p - c.position;
    if (!(dot(v, forward) > 0)) return false;
    const vec3d on_film = v / dot(v, forward) - f.corner;
    const double x = dot(on_film, f.dx) / dot(f.dx, f.dx), y = dot(on_film, f.dy) / dot(f.dy, f.dy);
    if (!(x >= 0 && x <= width && y >= 0 && y <= height)) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("every corner of the box is in the picture, whatever its shape, size and place") {
  for (double size : {1e-6, 1.0, 1e6})
    for (vec3d shape : {vec3d(1, 1, 1), vec3d(9, 1, 1), vec3d(1, 9, 1), vec3d(1, 1, 9),
                        vec3d(1, 0, 1), vec3d(1, 0, 0)})
      for (vec3d place : {vec3d(0, 0, 0), vec3d(1e3, -2e3, 5e3)}) {
        box3d box;
        box.add(place * size), box.add((place + shape) * size);
        const camera c = camera_that_frames(box);
        CHECK(sees(c, box, 800, 600));
        CHECK(sees(c, box, 500, 500));
      }
}

TEST_CASE("the view is raised and from the right, and upright") {
  box3d box;
  box.add(vec3d(-1, -1, -1)), box.add(vec3d(1, 1, 1));
  const camera c = camera_that_frames(box);
  CHECK(c.position.x > 0);
  CHECK(c.position.y > 0);
  CHECK(c.position.z > c.position.x);
  CHECK(c.up == vec3d(0, 1, 0));
  CHECK(c.look_at == vec3d(0, 0, 0));
}

TEST_CASE("a point is framed as if it had size 1, nothing by the default camera") {
  box3d point;
  point.add(vec3d(4, 4, 4));
  CHECK(length(camera_that_frames(point).position - vec3d(4, 4, 4)) > 1);
  CHECK(camera_that_frames(box3d{}).position == camera{}.position);
}

TEST_CASE("the key light travels with the view, down and to the right") {
  const facet::light key = facet::key_light_for({});
  CHECK(key.type == facet::light::kind::directional);
  CHECK(key.direction.z < 0);
  CHECK(key.direction.y < 0);
  CHECK(key.direction.x > 0);
}
