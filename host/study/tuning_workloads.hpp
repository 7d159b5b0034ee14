// What a device is tuned on: rays of each kind and pictures, of scenes that need no files.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

/// A scene, and which of its workloads take part.
struct tuning_scene {
  scene what;
  std::uint32_t width = 0, height = 0;  ///< pixels of its picture, and eye rays
  bool with_rays = true, with_picture = true;
};

/// A knot (rays and a picture, in which no ray follows another), hills (rays) and a still life of
/// glass and mirrors (a picture of depth 8). `is_quick`: some thousand triangles each, not 72,000
/// to 500,000.
std::vector<tuning_scene> tuning_scenes(std::uint32_t width, bool is_quick);

/// One thing that is timed.
struct tuning_workload {
  std::string name;         ///< "hills: bounce rays"
  std::uint32_t scene = 0;  ///< index of its tuning_scene
  bool is_picture = false;
  std::vector<tracer::ray> rays;                       ///< but for pictures
  bool any = false;                                    ///< any hit ends a ray
  std::uint32_t width = 0, height = 0, max_depth = 0;  ///< of a picture
};

/// One ray through the centre of each pixel; those of a packet's pixels are neighbours, as a
/// picture's are.
std::vector<tracer::ray> eye_rays_in_tiles(const scene& s, std::uint32_t width,
                                           std::uint32_t height);

/// The workloads of scene number `index`, which `on` holds: the picture, eye rays, and from each
/// of their hits a ray to the first light (if there is one) and one into a direction drawn over
/// the hemisphere, denser towards the normal by the cosine. The same hits give the same rays. Kinds
/// without any ray are left out.
std::vector<tuning_workload> workloads_of(tracer::device_scene& on, const tuning_scene& s,
                                          std::uint32_t index);

}  // namespace facet::study
