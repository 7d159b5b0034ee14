#include "tracer/wide_geometry.hpp"

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "tracer/binary_builder.hpp"
#include "tracer/given_tree.hpp"
#include "tracer/stopwatch.hpp"
#include "tracer/wide_layout.hpp"

namespace facet::tracer {
namespace {

/// What the device keeps, as it grows mesh by mesh.
struct arrays {
  std::vector<WideNode> nodes;
  std::vector<TriangleBlock> blocks;
  std::vector<TriangleInfo> infos;  ///< by slot
  std::vector<texel> normals;       ///< three a slot

  std::uint32_t slots() const { return std::uint32_t(infos.size()); }
};

/// Where a mesh stands in them.
struct mesh_place {
  std::uint32_t root = FACET_NONE, first_slot = 0, slots = 0;
};

host_binary_tree read(const binary_tree& t) {
  const runtime::host_accessor nodes{t.nodes, runtime::read_only};
  const runtime::host_accessor order{t.order, runtime::read_only};
  return {{nodes.begin(), nodes.begin() + std::ptrdiff_t(2 * std::size_t(t.count) - 1)},
          {order.begin(), order.begin() + std::ptrdiff_t(t.count)},
          t.root,
          t.depth};
}

/// The mesh's own order, in whole blocks.
std::vector<std::uint32_t> blocks_in_order(std::uint32_t count) {
  const std::uint32_t whole = (count + FACET_BLOCK - 1) / FACET_BLOCK * FACET_BLOCK;
  std::vector<std::uint32_t> order(whole, FACET_NONE);
  std::iota(order.begin(), order.begin() + std::ptrdiff_t(count), 0u);
  return order;
}

/// A lane without a triangle has what the first of its block has, as it repeats a corner of that.
void append_triangles(const packed_scene& from, const packed_mesh& m,
                      const std::vector<std::uint32_t>& order, bool smooth, arrays& to) {
  const std::size_t first = m.first_triangle, count = m.triangle_count;
  append_blocks(order, std::span(from.corners).subspan(3 * first, 3 * count), to.blocks);
  for (std::size_t slot = 0; slot < order.size(); ++slot) {
    const std::uint32_t there =
        order[slot] == FACET_NONE ? order[slot - slot % FACET_BLOCK] : order[slot];
    to.infos.push_back({there, from.triangle_materials[first + there], {}});
    if (!smooth) continue;
    const auto normals = from.normals.begin() + std::ptrdiff_t(3 * (first + there));
    to.normals.insert(to.normals.end(), normals, normals + 3);
  }
}

template <class T>
runtime::buffer<T> uploaded(const std::vector<T>& from) {
  return from.empty() ? runtime::buffer<T>(1) : runtime::buffer<T>(from.data(), from.size());
}

template <class T>
std::uint64_t bytes_of(const std::vector<T>& of) {
  return of.size() * sizeof(T);
}

}  // namespace

device_geometry build_wide_geometry(runtime::queue& q, const runtime::source_tree& kernels,
                                    packed_scene packed, const features& f, tree_kind kind,
                                    const tuning& t, std::span<const given_tree> given) {
  const std::uint64_t triangles = packed.world.triangle_count, largest = largest_mesh(packed);
  check_memory(q.get_device(), triangles,
               3 * sizeof(texel) * largest + binary_builder::scratch_bytes(largest));

  const auto start_build = clock::now();
  binary_builder build(q, kernels, t);
  arrays to;
  std::uint32_t depth = 0, binary_depth = 0;
  std::uint64_t binary_nodes = 0;
  std::vector<mesh_place> places(packed.meshes.size());
  for (std::size_t k = 0; k < packed.meshes.size(); ++k) {
    const packed_mesh& m = packed.meshes[k];
    if (m.triangle_count == 0) continue;
    mesh_place& there = places[k];
    there.first_slot = to.slots();
    if (kind == tree_kind::none) {
      append_triangles(packed, m, blocks_in_order(m.triangle_count), f.smooth, to);
    } else {
      const auto corners =
          std::span<const texel>(packed.corners)
              .subspan(3 * std::size_t(m.first_triangle), 3 * std::size_t(m.triangle_count));
      const auto built = [&] {
        runtime::buffer<texel> on_device(corners);
        return read(build.over_triangles(on_device, m.triangle_count));
      };
      const host_binary_tree binary = k < given.size() ? binary_of(given[k], corners) : built();
      const wide_tree tree =
          widened(binary.nodes, binary.root, m.triangle_count, FACET_BLOCK,
                  std::uint32_t(to.nodes.size()), there.first_slot / FACET_BLOCK);
      append_triangles(packed, m, tree.order, f.smooth, to);
      to.nodes.insert(to.nodes.end(), tree.nodes.begin(), tree.nodes.end());
      there.root = tree.root;
      depth = std::max(depth, tree.depth);
      binary_depth = std::max(binary_depth, binary.depth);
      binary_nodes += binary.nodes.size();
    }
    there.slots = to.slots() - there.first_slot;
  }
  std::vector<Instance>& placed = packed.instances;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const mesh_place& there = places[packed.instance_meshes[i]];
    placed[i].root = there.root;
    placed[i].first_triangle = there.first_slot;
    placed[i].triangle_count = there.slots;
  }
  if (!f.instances) {
    packed.world.root = placed.empty() ? FACET_NONE : placed[0].root;
  } else if (kind != tree_kind::none && !placed.empty()) {
    const host_binary_tree binary = read(build.over_instances(placed));
    const wide_tree top = widened(binary.nodes, binary.root, std::uint32_t(placed.size()), 1,
                                  std::uint32_t(to.nodes.size()), 0);
    std::vector<Instance> sorted;
    sorted.reserve(placed.size());
    for (const std::uint32_t i : top.order) sorted.push_back(placed[i]);
    placed = std::move(sorted);
    to.nodes.insert(to.nodes.end(), top.nodes.begin(), top.nodes.end());
    packed.world.root = top.root;
    depth += top.depth;
    binary_depth += binary.depth;
    binary_nodes += binary.nodes.size();
  }
  packed.world.triangle_count = to.slots();
  const std::uint64_t bytes = bytes_of(to.nodes) + bytes_of(to.blocks) + bytes_of(to.infos) +
                              bytes_of(to.normals) + bytes_of(placed) + bytes_of(packed.materials);
  check_memory(q.get_device(), triangles, bytes);
  const double build_ms = milliseconds_since(start_build);

  const auto start_upload = clock::now();
  // As texels, which is what a kernel's parameter counts in.
  const auto* corners = reinterpret_cast<const texel*>(to.blocks.data());
  device_geometry g{runtime::buffer<World>(&packed.world, 1),
                    runtime::buffer<Node>(1),
                    uploaded(to.nodes),
                    uploaded(placed),
                    uploaded(to.infos),
                    runtime::buffer<Material>(packed.materials.data(), packed.materials.size()),
                    to.blocks.empty()
                        ? runtime::buffer<texel>(1)
                        : runtime::buffer<texel>(corners, bytes_of(to.blocks) / sizeof(texel)),
                    uploaded(to.normals),
                    std::nullopt,
                    std::nullopt};
  q.wait_and_throw();
  g.is_wide = true;
  g.depth = binary_depth;
  // cl/search_wide.h: seven entries a level of either tree, and one where an instance is entered.
  g.stack = 7 * depth + (f.instances ? 1 : 0);
  g.nodes_used = binary_nodes;
  g.bytes = bytes;
  g.build_ms = build_ms;
  g.upload_ms = milliseconds_since(start_upload);
  g.compile_ms = build.compile_ms();
  return g;
}

}  // namespace facet::tracer
