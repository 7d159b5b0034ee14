#include "scene/framing.hpp"

#include <cmath>
#include <numbers>

namespace facet {

camera camera_that_frames(const box3d& box) {
  camera c;
  if (box.empty()) return c;
  const vec3d half = box.extent() * 0.5;
  const double reach = std::hypot(half.x, half.y, half.z);
  const double radius = reach > 0 ? reach : 0.5;
  constexpr double margin = 1.02;
  // A ball of that radius touches the picture's edges where its tangents leave the eye.
  const double distance = margin * radius / std::sin(c.vertical_fov * (std::numbers::pi / 360));
  c.look_at = box.centre();
  c.position = c.look_at + normalize(vec3d{0.55, 0.4, 1}) * distance;
  return c;
}

light key_light_for(const camera& c) {
  const vec3d forward = normalize(c.look_at - c.position);
  const vec3d right = normalize(cross(forward, c.up)), above = cross(right, forward);
  light key;
  key.type = light::kind::directional;
  key.direction = normalize(forward + right * 0.6 - above * 0.8);
  return key;
}

}  // namespace facet
