// The transparent objects that a point lies in.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace facet {

/// How often the mesh's surface of each material winds around p (in the mesh's coordinates), by
/// material: the sum of the solid angles of its triangles over 4 pi (Jacobson, Kavan, Sorkine 2013;
/// a triangle's by van Oosterom and Strackee 1983). 1 inside a closed surface that is
/// counter-clockwise from outside, 0 outside; in between where the surface is open.
std::vector<double> winding_numbers(const mesh& m, std::size_t material_count, vec3d p);

/// The materials of the transparent objects around a point in the world, innermost first: an object
/// in another has the smaller world box. Only objects whose world box holds the point are
/// looked at, triangle by triangle. An object is what one instance shows of one material.
std::vector<std::uint32_t> media_at(const scene& s, vec3d p);

/// Those around the scene's camera.
std::vector<std::uint32_t> media_around_camera(const scene& s);

/// Throws scene_error if the camera lies in more of them than `s.nesting` allows.
void check_camera_media(const scene& s, const std::vector<std::uint32_t>& media);

}  // namespace facet
