// Scenes of glass whose light is known without tracing.
#pragma once

#include <span>

#include "scene/scene.hpp"

namespace facet::study {

/// A picture of a wall, seen and lit through slabs of glass that lie within one another.
struct glass_scene {
  const char* name;
  scene (*make)();
  /// What the camera sees in the unit direction `way`, by Snell's law and Beer-Lambert in double.
  vec3d (*radiance)(const scene& s, vec3d way);
};

std::span<const glass_scene> glass_scenes();

/// A cube of half side `half` whose edges and corners are cut off by `bevel`: long thin triangles
/// along every edge. Closed and convex.
mesh bevelled_box(float half, float bevel);

}  // namespace facet::study
