// A scene's triangles and where its instances put them; rays against them, with trees or without.
// All roads end in triangle.hpp, so all give the same bits.
#pragma once

#include <cstdint>
#include <vector>

#include "reference/affine.hpp"
#include "reference/ray.hpp"
#include "reference/triangle.hpp"
#include "reference/wide_tree.hpp"
#include "scene/scene.hpp"

namespace facet::reference {

/// The triangles of a leaf, side by side: what the scene holds, copied for speed.
struct alignas(32) triangle_block {
  std::array<std::array<std::array<float, tree_width>, 3>, 3> corner;  ///< [corner][axis][lane]
  std::array<std::uint32_t, tree_width> triangle;
};

struct mesh_tree {
  box3f bounds;
  vec3f extent;               ///< the largest |coordinate| by axis
  std::vector<bool> is_shut;  ///< by triangle: scene/shut.hpp
  wide_tree tree;
  std::vector<triangle_block> blocks;  ///< by leaf; NaN corners where there is no triangle

  explicit mesh_tree(const mesh& m);
};

/// An instance in the scalar.
template <class T>
struct placement {
  affine<T> world_from_object, object_from_world;
  box3<T> world_box;  ///< empty for an instance of a mesh without triangles
  bool is_plain;      ///< seen from here a ray is what it is in the world, extent included
};

enum class road {
  tree,
  scan,         ///< no tree, and fast without: all triangles of each instance whose box is met
  brute_force,  ///< nothing is left out: what the others are held against
};

template <class T>
class geometry {
 public:
  explicit geometry(const scene& s);  ///< keeps a reference

  hit<T> closest(const ray<T>& r, road by) const;
  /// Is any triangle accepted?
  bool occluded(const ray<T>& r, road by) const;

  /// Calls visit(candidate) for each triangle that the ray may meet between tmin and `limit`, in no
  /// order, until it returns true; returns that. `limit` may shrink under way.
  template <class Visit>
  bool visit(const ray<T>& r, const T& limit, road by, Visit&& v) const;

  const placement<T>& placed(std::uint32_t instance) const { return placements_[instance]; }
  const mesh& mesh_of(std::uint32_t instance) const {
    return scene_.meshes[scene_.instances[instance].mesh];
  }
  corners<T> corners_of(std::uint32_t instance, std::uint32_t triangle) const {
    const mesh& m = mesh_of(instance);
    return {vec3<T>(m.position(triangle, 0)), vec3<T>(m.position(triangle, 1)),
            vec3<T>(m.position(triangle, 2))};
  }

 private:
  const scene& scene_;
  std::vector<mesh_tree> meshes_;
  std::vector<placement<T>> placements_;
  vec3<T> extent_;  ///< the largest |coordinate| by axis of all world boxes
  wide_tree tree_;  ///< over the instances that have triangles
};

/// A triangle on a ray's way, to be decided by its visitor.
template <class T>
struct candidate {
  const space<T>& world;
  const space<T>& object;
  const placement<T>& place;
  std::uint32_t instance, triangle;
  corners<T> corner;

  triangle_test<T> test() const { return {object, corner}; }
  /// The instance's interval in the world. In a plain one the triangle's own lies within it.
  interval<T> outer() const { return place.is_plain ? interval<T>{} : world.slab(place.world_box); }
};

extern template class geometry<float>;
extern template class geometry<double>;

}  // namespace facet::reference
