// A tree in a form that no layout shapes: what is said of trees is measured of this.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/vec.hpp"
#include "tracer/pack.hpp"
#include "tracer/tracer.hpp"

namespace facet::tracer {

/// The root is the first node, and a node's children stand together, behind it.
struct plain_tree {
  struct node {
    box3f box;  ///< empty where none is stored: of a root that is a leaf
    bool is_leaf = false;
    std::uint32_t first = 0;  ///< child in `nodes`, or primitive in `primitives`
    std::uint32_t count = 0;  ///< of these, at least one
  };
  std::vector<node> nodes;
  std::vector<std::uint32_t> primitives;  ///< triangles of the mesh, or instances of the scene
  /// Of the nodes and of what is in the leaves: what a ray may read of this tree.
  std::uint64_t bytes = 0;
};

/// Trees as they are traced, read back from the device.
struct traced_trees {
  std::vector<plain_tree> meshes;  ///< those that are shown and have triangles, in scene order
  plain_tree top;                  ///< over instances; without nodes if there is no such tree
};

/// The binary tree that the device builds over triangles, three corners each, and that every layout
/// is folded from: one triangle a leaf, bytes 0. Throws runtime::exception (invalid) for
/// tree_kind::none.
plain_tree built_tree(runtime::queue queue, tree_kind kind, std::span<const texel> corners);

/// The same of a caller's tree; throws as device_scene does.
plain_tree built_tree(const given_tree& given, std::span<const texel> corners);

}  // namespace facet::tracer
