#include "tracer/tree.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/leaf_order.hpp"
#include "tracer/node_trees.hpp"
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
  return kept + uploaded + node_trees::scratch_bytes(largest_mesh) +
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

/// Puts several trees' nodes into one array, and buffers on the device.
class node_array {
 public:
  node_array(runtime::queue& q, const runtime::source_tree& kernels, const tuning& t)
      : queue_(q),
        group_(t.group),
        program_(compiled(q, kernels, "tree.cl", t.flags())),
        touch_(program_.get_kernel("touch")),
        append_nodes_(program_.get_kernel("append_nodes")) {}

  void add_programs(program_set& to) const { to.add(program_); }

  /// Puts the tree's nodes behind the first `nodes`; its places are then counted from `slots` on.
  void append(node_tree& tree, runtime::buffer<Node>& all, std::uint32_t nodes,
              std::uint32_t slots) {
    if (tree.node_count == 0) return;
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor from{tree.nodes, h, runtime::read_only};
      const runtime::accessor to{all, h, runtime::read_write};
      h.set_args(from, to, tree.node_count, nodes, slots);
      h.parallel_for(padded(tree.node_count, group_), append_nodes_);
    });
  }

  /// Moves a buffer to the device: otherwise it goes there when a command first needs it.
  template <class T>
  void touch(runtime::buffer<T>& b) {
    queue_.submit([&](runtime::handler& h) {
      h.set_args(runtime::accessor{b, h, runtime::read_only});
      h.single_task(touch_);
    });
  }

 private:
  runtime::queue& queue_;
  std::uint32_t group_;
  runtime::program program_;
  runtime::kernel touch_, append_nodes_;
};

runtime::buffer<std::uint32_t> identity_order(std::uint32_t count) {
  std::vector<std::uint32_t> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = i;
  return runtime::buffer<std::uint32_t>(order.data(), order.size());
}

}  // namespace

void set_depth(device_geometry& g, bool has_instances, const top_plan* top) {
  const std::uint32_t levels = g.mesh_levels + (top ? top->levels : 0);
  g.depth = g.mesh_depth + (top ? top->tree.depth : 0);
  // One entry a node on the way down (cl/search_narrow.h), or seven (cl/search_wide.h), and one
  // where an instance is entered.
  g.stack = (g.is_wide ? 7 : 1) * levels + (has_instances ? 1 : 0);
  g.nodes_used = g.mesh_nodes_used + (top ? top->tree.node_count : 0);
}

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

  node_array array(q, kernels, t);
  leaf_order gather(q, kernels, t);
  std::optional<node_trees> build;
  if (kind != tree_kind::none)
    build.emplace(q, kernels, t, kind, leaf_rule{t.leaf_sure, t.leaf_size}, true)
        .prepare(largest_mesh(packed));
  std::optional<top_level> over_instances;
  if (kind != tree_kind::none && f.instances && !packed.instances.empty())
    over_instances.emplace(q, kernels, t, kind, false, packed.instances.size());
  const std::size_t texels =
      in_images ? whole_rows(3 * triangles) : std::max<std::size_t>(1, 3 * triangles);
  const std::size_t instances = packed.instances.size();
  device_geometry g{runtime::buffer<World>(1),
                    runtime::buffer<Node>(1),
                    runtime::buffer<WideNode>(1),
                    runtime::buffer<Instance>(std::max<std::size_t>(1, instances)),
                    runtime::buffer<TriangleInfo>(std::max<std::size_t>(1, triangles)),
                    runtime::buffer<Material>(packed.materials.data(), packed.materials.size()),
                    runtime::buffer<texel>(texels),
                    runtime::buffer<texel>(smooth ? texels : 1),
                    std::nullopt,
                    std::nullopt};

  double build_ms = 0, upload_ms = 0;
  std::vector<std::optional<node_tree>> trees(packed.meshes.size());
  for (std::size_t k = 0; k < packed.meshes.size(); ++k) {
    const packed_mesh& m = packed.meshes[k];
    if (m.triangle_count == 0) continue;
    const auto start_upload = clock::now();
    const std::size_t first = 3 * std::size_t(m.first_triangle),
                      size = 3 * std::size_t(m.triangle_count);
    runtime::buffer<texel> corners(packed.corners.data() + first, size);
    runtime::buffer<std::uint32_t> materials(packed.triangle_materials.data() + m.first_triangle,
                                             m.triangle_count);
    array.touch(corners);
    array.touch(materials);
    q.wait_and_throw();
    upload_ms += milliseconds_since(start_upload);

    const auto start_build = clock::now();
    const leaf_triangles sorted{materials, g.corners, g.infos, m.first_triangle};
    runtime::buffer<std::uint32_t> order(1);
    const bool is_given = k < given.size();
    if (kind == tree_kind::none) {
      order = identity_order(m.triangle_count);
    } else {
      trees[k] = is_given ? build->from(given[k],
                                        std::span<const texel>(packed.corners).subspan(first, size))
                          : build->over_triangles(corners, m.triangle_count, &sorted);
      order = trees[k]->order;
      g.mesh_nodes_used += trees[k]->node_count;
    }
    if (kind == tree_kind::none || is_given)
      gather.triangles(order, corners, m.triangle_count, sorted);
    if (smooth) {
      runtime::buffer<texel> normals(packed.normals.data() + first, size);
      gather.normals(order, normals, g.normals, m.triangle_count, m.first_triangle);
    }
    q.wait_and_throw();
    build_ms += milliseconds_since(start_build);
  }

  const auto start_top = clock::now();
  std::vector<Instance>& placed = packed.instances;
  std::optional<top_plan> top;
  if (over_instances) top = over_instances->plan(placed);
  // One tree stays where it was built; several are put into one array.
  const bool is_one = !top && packed.meshes.size() == 1;
  if (is_one && trees[0])
    g.nodes = trees[0]->nodes;
  else
    g.nodes =
        runtime::buffer<Node>(std::max<std::size_t>(1, g.mesh_nodes_used + (top ? top->nodes : 0)));
  g.meshes.resize(packed.meshes.size());
  std::uint32_t node = 0;
  for (std::size_t k = 0; k < trees.size(); ++k) {
    mesh_place& there = g.meshes[k];
    there.first_slot = packed.meshes[k].first_triangle;
    there.slots = packed.meshes[k].triangle_count;
    if (!trees[k]) continue;
    if (!is_one) array.append(*trees[k], g.nodes, node, there.first_slot);
    there.root = trees[k]->root + (trees[k]->root & FACET_LEAF_BIT ? there.first_slot : node);
    there.first_node = node;
    there.nodes = trees[k]->node_count;
    node += there.nodes;
    g.mesh_depth = std::max(g.mesh_depth, trees[k]->depth);
  }
  g.mesh_levels = g.mesh_depth;
  g.first_top_node = node;
  for (std::size_t i = 0; i < placed.size(); ++i)
    placed[i].root = g.meshes[packed.instance_meshes[i]].root;
  if (top)
    packed.world.root = over_instances->write(*top, g, node, placed);
  else if (!f.instances)
    packed.world.root = placed.empty() ? FACET_NONE : placed[0].root;
  set_depth(g, f.instances, top ? &*top : nullptr);
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
  array.add_programs(g.programs);
  gather.add_programs(g.programs);
  if (build) build->add_programs(g.programs);
  if (over_instances) over_instances->add_programs(g.programs);
  g.bytes = g.nodes.byte_size() + g.instances.byte_size() + g.infos.byte_size() +
            g.materials.byte_size() + texels * sizeof(texel) * (smooth ? 2 : 1);
  return g;
}

}  // namespace facet::tracer
