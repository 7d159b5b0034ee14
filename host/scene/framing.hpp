// A camera and lights for scenes that bring none.
#pragma once

#include "scene/scene.hpp"
#include "scene/vec.hpp"

namespace facet {

/// A camera that sees all of `box` in a picture that is at least as wide as high, from a slightly
/// raised three-quarter view (to the right of +z, y up). A box without extent counts as one of
/// size 1; for an empty one it is the default camera.
camera camera_that_frames(const box3d& box);

/// A white directional light that travels from above the camera's left shoulder into the view.
light key_light_for(const camera& c);

}  // namespace facet
