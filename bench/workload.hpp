// The workload of the trace figures: one mesh scaled to a longest side of 1 around the origin, the
// eye rays of a picture in tiles of 8 x 4, and from each of their hits one shadow ray and one
// bounce ray. The floats are part of the definition: peers are compared on the same rays.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reference/ray.hpp"
#include "scene/scene.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {

inline constexpr int picture_width = 1920, picture_height = 1080;
inline constexpr int tile_width = 8, tile_height = 4, tile_rays = tile_width * tile_height;

using ray = reference::ray<float>;
using hit = reference::hit<float>;

/// "terrain:N" (2 N^2 triangles), "soup:N" (N triangles) or the path of an OBJ file, normalised.
/// Throws scene_error if the file cannot be read or holds no triangle.
mesh load_workload(const std::string& name);

/// The mesh alone: one instance under the identity, one material.
scene scene_of(mesh m);

/// Pixels, so that a picture of that width has the scene's own aspect ratio.
std::uint32_t height_for(const scene& s, std::uint32_t width);

/// Tile by tile, so that each tile_rays rays are neighbours. The width is a multiple of 8, the
/// height one of 4.
std::vector<ray> primary_rays(int width = picture_width, int height = picture_height);

/// As the device tracer takes them.
std::vector<tracer::ray> packed(const std::vector<ray>& rays);

/// Rays from the hits of `primary`, in the same order, misses left out.
std::vector<ray> bounce_rays(const mesh& m, const std::vector<ray>& primary,
                             const std::vector<hit>& hits);
/// t = 1 is the light.
std::vector<ray> shadow_rays(const mesh& m, const std::vector<ray>& primary,
                             const std::vector<hit>& hits);

}  // namespace facet::bench
