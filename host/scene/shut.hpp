// Triangles that no ray meets: those without an area, but for the ones that close a seam.
#pragma once

#include <vector>

#include "scene/mesh.hpp"

namespace facet {

/// False where the corners lie on one line: exact, as differences and products of floats fit a
/// double, unless their sizes differ by more than 2^28.
bool has_area(vec3f a, vec3f b, vec3f c);

/// One entry a triangle: true if no ray may meet it.
///
/// Triangles without an area are shut: rounding might open them to a ray. But where three different
/// corners on one line are all shared, as in a mesh that was moved far away and rounded, the two
/// long edges that meet there have rounded slopes of their own, and a ray may pass between: only
/// the triangle without an area, as the ray sees it, closes that gap (case 4 of `facet accuracy`
/// counted 8 leaks in a million without it). So it stays open if each of its edges is
/// another open triangle's, too, and it hangs together with one that has an area.
std::vector<bool> shut_triangles(const mesh& m);

}  // namespace facet
