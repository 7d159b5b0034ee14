// A picture with all kinds of rays: a mesh between a glass and a mirror sphere on a reflecting
// floor, under two lights.
#pragma once

#include "scene/scene.hpp"

namespace facet::study {

/// 1920x1080 pixels, 5 bounces; the mesh is scaled to a longest side of 1 and stands on the floor.
scene still_life(mesh m);

}  // namespace facet::study
