// Boxes of instances in the world: what rays are culled against.
#pragma once

#include "scene/scene.hpp"
#include "scene/vec.hpp"

namespace facet {

/// The world box of an instance of a mesh with the given bounds. Under the identity it is the
/// bounds themselves; otherwise it holds the image of the bounds, grown on each axis i by
/// g * (sum_j |m_ij| * M_j + |m_i3|) with M = max(|lo|, |hi|), g = 2^-20 for float and 2^-45 for
/// double, and rounded outward: wider than the rounding of any ray's way to object space and back.
/// T is float or double. An empty box stays empty.
template <class T>
box3<T> world_box(const transform& world_from_object, const box3f& mesh_bounds);

/// The same, with the bounds taken from the mesh (one pass over its triangles).
template <class T>
box3<T> world_box(const instance& placed, const mesh& m);

/// The union of all instances' boxes; empty without any. Throws std::out_of_range for an instance
/// of a mesh that is not there.
template <class T>
box3<T> world_box(const scene& s);

}  // namespace facet
