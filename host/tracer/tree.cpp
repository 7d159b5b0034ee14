#include "tracer/tree.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tracer/binary_builder.hpp"
#include "tracer/given_tree.hpp"
#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t image_width = 1u << 13;  ///< cl/geometry.h: FACET_IMAGE_BITS

/// Bytes that building and keeping the geometry takes at its peak.
std::uint64_t peak_bytes(std::uint64_t triangles, std::uint64_t largest_mesh, bool smooth,
                         bool in_images) {
  const std::uint64_t corners = 48, normals = smooth ? 48u : 0u;
  const std::uint64_t kept = triangles * (sizeof(Node) + sizeof(TriangleInfo) + corners + normals);
  const std::uint64_t uploaded = triangles * (corners + normals + 4);
  return kept + uploaded + binary_builder::scratch_bytes(largest_mesh) +
         (in_images ? triangles * (corners + normals) : 0);
}

/// An image of `texels` in rows of image_width, filled from a buffer of whole rows.
runtime::image2d image_of(runtime::queue& q, runtime::buffer<texel>& from) {
  const std::size_t rows = from.size() / image_width;
  const runtime::device d = q.get_device();
  if (rows > d.image2d_max_height() || image_width > d.image2d_max_width())
    throw runtime::exception(
        runtime::errc::memory_allocation,
        std::to_string(from.size() / 3) + " triangles need an image of " +
            std::to_string(image_width) + "x" + std::to_string(rows) + ", and " + d.name() +
            " allows " + std::to_string(d.image2d_max_width()) + "x" +
            std::to_string(d.image2d_max_height()) + "; use --geometry buffer");
  runtime::image2d image(image_width, rows);
  q.submit([&](runtime::handler& h) {
    const runtime::accessor source{from, h, runtime::read_only};
    const runtime::image_accessor target{image, h, runtime::write_only};
    h.copy(source, target);
  });
  return image;
}

std::size_t whole_rows(std::size_t texels) {
  return std::max<std::size_t>(1, (texels + image_width - 1) / image_width) * image_width;
}

/// The steps from binary trees to what traversal reads.
class geometry_builder {
 public:
  geometry_builder(runtime::queue& q, const runtime::source_tree& kernels, const tuning& t)
      : queue_(q),
        tuning_(t),
        binary_(q, kernels, t),
        program_(compiled(q, kernels, "tree.cl", t.flags())),
        make_nodes_(program_.get_kernel("make_nodes")),
        gather_triangles_(program_.get_kernel("gather_triangles")),
        gather_normals_(program_.get_kernel("gather_normals")) {}

  double compile_ms() const { return binary_.compile_ms() + program_.build_ms(); }

  binary_tree over_triangles(runtime::buffer<texel>& corners, std::uint32_t count) {
    return binary_.over_triangles(corners, count);
  }

  binary_tree over_instances(const std::vector<Instance>& placed) {
    return binary_.over_instances(placed);
  }

  static binary_tree from(const given_tree& given, std::span<const texel> corners) {
    const host_binary_tree t = binary_of(given, corners);
    return {runtime::buffer<TreeNode>(t.nodes.data(), t.nodes.size()),
            runtime::buffer<std::uint32_t>(t.order.data(), t.order.size()),
            std::uint32_t(t.order.size()), t.root, t.depth};
  }

  /// Writes the tree's nodes from node_offset on; returns how its root is named as a child.
  std::uint32_t emit(binary_tree& tree, runtime::buffer<Node>& nodes, std::uint32_t leaf_size,
                     std::uint32_t node_offset, std::uint32_t slot_offset) {
    if (tree.count <= leaf_size) return FACET_LEAF(slot_offset, tree.count);
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor in{tree.nodes, h, runtime::read_only};
      const runtime::accessor out{nodes, h, runtime::read_write};
      h.set_args(in, out, tree.count, leaf_size, node_offset, slot_offset);
      h.parallel_for(padded(tree.count, tuning_.group), make_nodes_);
    });
    return node_offset + (tree.root - tree.count);
  }

  void gather(runtime::buffer<std::uint32_t>& order, runtime::buffer<texel>& corners,
              runtime::buffer<std::uint32_t>& materials, device_geometry& to, std::uint32_t count,
              std::uint32_t slot_offset) {
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor from{order, h, runtime::read_only};
      const runtime::accessor in{corners, h, runtime::read_only};
      const runtime::accessor in_materials{materials, h, runtime::read_only};
      const runtime::accessor out{to.corners, h, runtime::read_write};
      const runtime::accessor infos{to.infos, h, runtime::read_write};
      h.set_args(from, in, in_materials, out, infos, count, slot_offset);
      h.parallel_for(padded(count, tuning_.group), gather_triangles_);
    });
  }

  void gather_normals(runtime::buffer<std::uint32_t>& order, runtime::buffer<texel>& normals,
                      device_geometry& to, std::uint32_t count, std::uint32_t slot_offset) {
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor from{order, h, runtime::read_only};
      const runtime::accessor in{normals, h, runtime::read_only};
      const runtime::accessor out{to.normals, h, runtime::read_write};
      h.set_args(from, in, out, count, slot_offset);
      h.parallel_for(padded(count, tuning_.group), gather_normals_);
    });
  }

 private:
  runtime::queue& queue_;
  const tuning& tuning_;
  binary_builder binary_;
  runtime::program program_;
  runtime::kernel make_nodes_, gather_triangles_, gather_normals_;
};

runtime::buffer<std::uint32_t> identity_order(std::uint32_t count) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  return runtime::buffer<std::uint32_t>(order.data(), order.size());
}

}  // namespace

void check_memory(const runtime::device& d, std::uint64_t triangles, std::uint64_t peak) {
  if (peak > d.global_mem_size())
    throw runtime::exception(
        runtime::errc::memory_allocation,
        "the scene's " + std::to_string(triangles) + " triangles need about " +
            std::to_string(peak >> 20) + " MiB on the device while their tree is built, and " +
            d.name() + " has " + std::to_string(d.global_mem_size() >> 20) +
            " MiB; use fewer triangles, instances instead of copies, or a larger device");
}

device_geometry build_geometry(runtime::queue& q, const runtime::source_tree& kernels,
                               packed_scene packed, const features& f, tree_kind kind,
                               bool in_images, const tuning& t, std::span<const given_tree> given) {
  const std::size_t triangles = packed.world.triangle_count;
  const bool smooth = f.smooth;
  const std::uint64_t peak = peak_bytes(triangles, largest_mesh(packed), smooth, in_images);
  check_memory(q.get_device(), triangles, peak);

  geometry_builder build(q, kernels, t);
  const std::size_t texels =
      in_images ? whole_rows(3 * triangles) : std::max<std::size_t>(1, 3 * triangles);
  const std::size_t instances = packed.instances.size();
  device_geometry g{runtime::buffer<World>(1),
                    runtime::buffer<Node>(std::max<std::size_t>(1, triangles + instances)),
                    runtime::buffer<WideNode>(1),
                    runtime::buffer<Instance>(std::max<std::size_t>(1, instances)),
                    runtime::buffer<TriangleInfo>(std::max<std::size_t>(1, triangles)),
                    runtime::buffer<Material>(packed.materials.data(), packed.materials.size()),
                    runtime::buffer<texel>(texels),
                    runtime::buffer<texel>(smooth ? texels : 1),
                    std::nullopt,
                    std::nullopt};

  double build_ms = 0, upload_ms = 0;
  std::vector<std::uint32_t> roots(packed.meshes.size(), FACET_NONE);
  std::vector<std::uint32_t> depths(packed.meshes.size(), 0);
  for (std::size_t k = 0; k < packed.meshes.size(); ++k) {
    const packed_mesh& m = packed.meshes[k];
    if (m.triangle_count == 0) continue;
    const auto start_upload = clock::now();
    const std::size_t first = 3 * std::size_t(m.first_triangle),
                      size = 3 * std::size_t(m.triangle_count);
    runtime::buffer<texel> corners(packed.corners.data() + first, size);
    runtime::buffer<std::uint32_t> materials(packed.triangle_materials.data() + m.first_triangle,
                                             m.triangle_count);
    q.wait_and_throw();
    upload_ms += milliseconds_since(start_upload);

    const auto start_build = clock::now();
    runtime::buffer<std::uint32_t> order(1);
    if (kind == tree_kind::none) {
      order = identity_order(m.triangle_count);
    } else {
      binary_tree tree =
          k < given.size()
              ? build.from(given[k], std::span<const texel>(packed.corners).subspan(first, size))
              : build.over_triangles(corners, m.triangle_count);
      roots[k] = build.emit(tree, g.nodes, t.leaf_size, m.first_triangle, m.first_triangle);
      depths[k] = tree.depth;
      order = tree.order;
      g.nodes_used += 2 * std::uint64_t(m.triangle_count) - 1;
    }
    build.gather(order, corners, materials, g, m.triangle_count, m.first_triangle);
    if (smooth) {
      runtime::buffer<texel> normals(packed.normals.data() + first, size);
      build.gather_normals(order, normals, g, m.triangle_count, m.first_triangle);
    }
    q.wait_and_throw();
    build_ms += milliseconds_since(start_build);
  }

  const auto start_top = clock::now();
  std::uint32_t mesh_depth = 0;
  std::vector<Instance>& placed = packed.instances;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const std::uint32_t k = packed.instance_meshes[i];
    placed[i].root = roots[k];
    mesh_depth = std::max(mesh_depth, depths[k]);
  }
  if (!f.instances) {
    packed.world.root = placed.empty() ? FACET_NONE : placed[0].root;
    g.depth = mesh_depth;
  } else if (kind != tree_kind::none && !placed.empty()) {
    binary_tree top = build.over_instances(placed);
    packed.world.root = build.emit(top, g.nodes, 1, packed.world.triangle_count, 0);
    g.nodes_used += 2 * std::uint64_t(placed.size()) - 1;
    const runtime::host_accessor order{top.order, runtime::read_only};
    std::vector<Instance> sorted;
    for (std::size_t i = 0; i < placed.size(); ++i) sorted.push_back(placed[order[i]]);
    placed = std::move(sorted);
    g.depth = top.depth + mesh_depth;
  }
  // cl/search_narrow.h: one entry a level of either tree, and one where an instance is entered.
  g.stack = g.depth + (f.instances ? 1 : 0);
  if (!placed.empty()) g.instances = runtime::buffer<Instance>(placed.data(), placed.size());
  g.world = runtime::buffer<World>(&packed.world, 1);
  if (in_images) {
    g.corner_image = image_of(q, g.corners);
    g.normal_image = smooth ? image_of(q, g.normals) : runtime::image2d(1, 1);
    q.wait_and_throw();
    g.corners = g.normals = runtime::buffer<texel>(1);
  }
  q.wait_and_throw();
  g.build_ms = build_ms + milliseconds_since(start_top);
  g.upload_ms = upload_ms;
  g.compile_ms = build.compile_ms();
  g.bytes = g.nodes.byte_size() + g.instances.byte_size() + g.infos.byte_size() +
            g.materials.byte_size() + texels * sizeof(texel) * (smooth ? 2 : 1);
  return g;
}

}  // namespace facet::tracer
