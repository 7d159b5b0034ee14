// Trees as they are traced, read back: device_scene::read_trees.
#include <map>
#include <string>
#include <utility>

#include "tracer/plain_tree.hpp"
#include "tracer/state.hpp"

namespace facet::tracer {
namespace {

/// A child as its node names it.
struct named {
  std::uint32_t child;
  box3f box;
};

/// What is a layout's own: the children that a node names, appended. This one is for nodes of one
/// array a side of an axis, Node and WideNode.
template <class N>
void append_children(const N& n, std::vector<named>& to) {
  for (std::size_t k = 0; k < std::size(n.child); ++k)
    if (n.child[k] != FACET_NONE)
      to.push_back(
          {n.child[k], {{n.x[0][k], n.y[0][k], n.z[0][k]}, {n.x[1][k], n.y[1][k], n.z[1][k]}}});
}

/// The tree below `root`. append_leaf(leaf, primitives) appends what a leaf holds and returns its
/// bytes.
template <class N, class AppendLeaf>
plain_tree read(std::span<const N> from, std::uint32_t root, const AppendLeaf& append_leaf) {
  plain_tree to;
  to.nodes.emplace_back();
  std::vector<named> children;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> waiting{{root, 0}};  // child, to
  std::size_t read = 0;
  while (!waiting.empty()) {
    const auto [child, at] = waiting.back();
    waiting.pop_back();
    const bool is_leaf = child & FACET_LEAF_BIT;
    if (!is_leaf && (child >= from.size() || ++read > from.size()))
      throw runtime::exception(runtime::errc::runtime,
                               "the device's tree names node " + std::to_string(child) + " of " +
                                   std::to_string(from.size()) + ", or one twice");
    const std::size_t first = is_leaf ? to.primitives.size() : to.nodes.size();
    if (is_leaf) {
      to.bytes += append_leaf(child, to.primitives);
    } else {
      to.bytes += sizeof(N);
      children.clear();
      append_children(from[child], children);
      for (const named& c : children) {
        if (at == 0) to.nodes[0].box.add(c.box);
        waiting.push_back({c.child, std::uint32_t(to.nodes.size())});
        to.nodes.push_back({c.box});
      }
    }
    plain_tree::node& made = to.nodes[at];
    made.is_leaf = is_leaf;
    made.first = std::uint32_t(first);
    made.count = std::uint32_t((is_leaf ? to.primitives.size() : to.nodes.size()) - first);
  }
  return to;
}

/// What a slot takes: a triangle's corners, where it comes from, and its normals.
std::uint64_t slot_bytes(bool smooth) {
  return sizeof(TriangleInfo) + (smooth ? 6 : 3) * sizeof(texel);
}

/// All trees of a scene that share an array of nodes. append_triangles: as append_leaf of read().
template <class N, class AppendTriangles>
traced_trees read_all(const runtime::buffer<N>& node_buffer,
                      const runtime::buffer<Instance>& instance_buffer, const World& world,
                      bool has_top, const AppendTriangles& append_triangles) {
  const runtime::host_accessor nodes{node_buffer, runtime::read_only};
  const runtime::host_accessor instances{instance_buffer, runtime::read_only};
  const std::span<const N> from(nodes.begin(), nodes.end());
  std::map<std::uint32_t, std::uint32_t> roots;  // by a mesh's first slot: in the scene's order
  for (std::uint32_t i = 0; i < world.instance_count; ++i)
    roots[instances[i].first_triangle] = instances[i].root;
  traced_trees all;
  for (const auto& [first, root] : roots) all.meshes.push_back(read(from, root, append_triangles));
  if (has_top && world.instance_count > 0)
    all.top = read(from, world.root, [&](std::uint32_t leaf, std::vector<std::uint32_t>& to) {
      for (std::uint32_t k = 0; k < FACET_LEAF_COUNT(leaf); ++k)
        to.push_back(instances[FACET_LEAF_FIRST(leaf) + k].id);
      return FACET_LEAF_COUNT(leaf) * sizeof(Instance);
    });
  return all;
}

}  // namespace

traced_trees device_scene::read_trees() const {
  const state& s = *state_;
  if (s.chosen.tree == tree_kind::none)
    throw runtime::exception(runtime::errc::invalid,
                             "a scene without trees has none to be read; choose a builder");
  const device_geometry& g = s.geometry;
  const World world = runtime::host_accessor{g.world, runtime::read_only}[0];
  const runtime::host_accessor infos{g.infos, runtime::read_only};
  const std::uint64_t bytes = slot_bytes(s.used.smooth);
  // A lane of a block that holds no triangle repeats the first one's number.
  const auto append_block = [&](std::uint32_t leaf, std::vector<std::uint32_t>& to) {
    const std::size_t first = std::size_t(FACET_BLOCK) * FACET_LEAF_FIRST(leaf);
    to.push_back(infos[first].triangle);
    for (std::size_t lane = 1; lane < FACET_BLOCK; ++lane)
      if (infos[first + lane].triangle != infos[first].triangle)
        to.push_back(infos[first + lane].triangle);
    return FACET_BLOCK * bytes;
  };
  const auto append_slots = [&](std::uint32_t leaf, std::vector<std::uint32_t>& to) {
    for (std::uint32_t k = 0; k < FACET_LEAF_COUNT(leaf); ++k)
      to.push_back(infos[FACET_LEAF_FIRST(leaf) + k].triangle);
    return FACET_LEAF_COUNT(leaf) * bytes;
  };
  return g.is_wide ? read_all(g.wide_nodes, g.instances, world, s.used.instances, append_block)
                   : read_all(g.nodes, g.instances, world, s.used.instances, append_slots);
}

}  // namespace facet::tracer
