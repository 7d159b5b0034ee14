// A whole scene's geometry on a device, ready to be traced: one tree a mesh, one over instances.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/features.hpp"
#include "tracer/pack.hpp"
#include "tracer/top_level.hpp"
#include "tracer/tracer.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Where a mesh stands in the scene's arrays; one that no instance shows has no slots.
struct mesh_place {
  std::uint32_t root = FACET_NONE;          ///< of its tree, as a child
  std::uint32_t first_node = 0, nodes = 0;  ///< that the layout has of its tree
  std::uint32_t first_slot = 0, slots = 0;  ///< in the wide layout those of whole blocks
};

/// What cl/traverse.h reads, in the order of a kernel's first arguments.
struct device_geometry {
  runtime::buffer<World> world;
  runtime::buffer<Node> nodes;           ///< of the narrow layout, 1 in the wide one
  runtime::buffer<WideNode> wide_nodes;  ///< the other way round
  runtime::buffer<Instance> instances;   ///< in the order of the top tree's leaves
  runtime::buffer<TriangleInfo> infos;   ///< in leaf order
  runtime::buffer<Material> materials;
  /// In leaf order; empty where images hold them. In the wide layout corners are TriangleBlocks.
  runtime::buffer<texel> corners, normals;
  std::optional<runtime::image2d> corner_image, normal_image;
  bool is_wide = false;

  std::vector<mesh_place> meshes{};   ///< by mesh of the scene
  std::uint32_t first_top_node = 0;   ///< the tree over instances stands behind all others
  std::uint32_t mesh_depth = 0;       ///< of the deepest mesh's binary tree
  std::uint32_t mesh_levels = 0;      ///< the layout's nodes on the longest way down in a mesh
  std::uint64_t mesh_nodes_used = 0;  ///< of the meshes' binary trees
  std::uint32_t stack = 1;       ///< entries that traversal may need (cl/features.h: FACET_STACK)
  std::uint32_t depth = 0;       ///< deepest way from the top's root to a leaf
  std::uint64_t nodes_used = 0;  ///< of all binary trees that the layout is made from
  std::uint64_t bytes = 0;       ///< of device memory that stays allocated
  program_set programs{};        ///< that it was made by
  double upload_ms = 0, build_ms = 0;
};

/// Sets what follows from the meshes' trees and the tree over instances, if there is one: depth,
/// stack and nodes_used.
void set_depth(device_geometry& g, bool has_instances, const top_plan* top);

/// Throws runtime::exception (memory_allocation) if `peak` bytes, which building the trees of that
/// many triangles takes, are more than the device has.
void check_memory(const runtime::device& d, std::uint64_t triangles, std::uint64_t peak);

/// Uploads the packed scene, builds its trees (unless tree_kind::none) and puts all into leaf
/// order. With f.instances off the scene's one mesh is the root. Throws runtime::exception
/// (memory_allocation) before anything is allocated if the device cannot hold it.
device_geometry build_geometry(runtime::queue& q, const runtime::source_tree& kernels,
                               packed_scene packed, const features& f, tree_kind tree,
                               bool in_images, const tuning& t,
                               std::span<const given_tree> given = {});

}  // namespace facet::tracer
