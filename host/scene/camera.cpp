#include <cmath>
#include <numbers>
#include <string>

#include "scene/error.hpp"
#include "scene/scene.hpp"

namespace facet {
namespace {

/// Sine of the smallest angle between `up` and the view: below it the picture's roll would be
/// made of the rounding of the coordinates.
constexpr double smallest_up_angle = 1e-9;

/// hypot neither overflows nor underflows, so any length but 0 will do.
double size(vec3d v) { return std::hypot(v.x, v.y, v.z); }

}  // namespace

camera_frame frame_of(const camera& c, std::uint32_t width, std::uint32_t height) {
  if (width == 0 || height == 0)
    throw scene_error("", width == 0 ? "/picture/width" : "/picture/height",
                      "is 0; a picture is at least 1 pixel wide and high");
  if (!(c.vertical_fov > 0 && c.vertical_fov < 180))
    throw scene_error("", "/camera/vertical_fov",
                      "is " + std::to_string(c.vertical_fov) +
                          " degrees; it must be between 0 and 180, both excluded");
  const vec3d view = c.look_at - c.position;
  const double distance = size(view), up_size = size(c.up);
  if (!(distance > 0) || !std::isfinite(distance))
    throw scene_error("", "/camera/look_at",
                      "is where the camera's position is (or not a finite distance from it), so "
                      "there is no direction to look in; move one of the two");
  const vec3d forward = view / distance;
  const vec3d across = up_size > 0 ? cross(forward, c.up / up_size) : vec3d{};
  if (!(size(across) > smallest_up_angle))
    throw scene_error("", "/camera/up",
                      "is 0 or along the line of sight, so the picture's upright is not defined; "
                      "give a direction that is across the view");
  const vec3d right = across / size(across), above = cross(right, forward);

  const double half = std::tan(c.vertical_fov * (std::numbers::pi / 360));
  const double pixel = 2 * half / height;
  camera_frame f;
  f.origin = c.position;
  f.dx = right * pixel;
  f.dy = -above * pixel;
  f.corner = forward - right * (pixel * width / 2) + above * half;
  return f;
}

}  // namespace facet
