#include "tracer/wide_geometry.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "tracer/blocks.hpp"
#include "tracer/fold.hpp"
#include "tracer/node_trees.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {
namespace {

std::uint32_t blocks_of(std::uint32_t triangles) {
  return (triangles + FACET_BLOCK - 1) / FACET_BLOCK;
}

runtime::buffer<std::uint32_t> uploaded(const std::vector<std::uint32_t>& from) {
  return {from.data(), from.size()};
}

/// The mesh's own order, in whole blocks.
block_list blocks_in_order(std::uint32_t triangles) {
  std::vector<std::uint32_t> leaves, order(triangles);
  for (std::uint32_t first = 0; first < triangles; first += FACET_BLOCK)
    leaves.push_back(FACET_LEAF(first, std::min(FACET_BLOCK, triangles - first)));
  std::iota(order.begin(), order.end(), 0u);
  return {uploaded(leaves), uploaded(order), blocks_of(triangles)};
}

/// A mesh with its tree, until its place in the scene's arrays is known.
struct planned_mesh {
  std::uint32_t mesh;
  runtime::buffer<texel> corners;
  runtime::buffer<std::uint32_t> materials;
  node_tree tree;
  fold_plan fold;
};

/// Plans all trees before it writes any: only then is it known how large the scene's arrays are.
class wide_builder {
 public:
  wide_builder(runtime::queue& q, const runtime::source_tree& kernels, packed_scene packed,
               const features& f, tree_kind kind, const tuning& t, bool is_movable)
      : queue_(q),
        packed_(std::move(packed)),
        features_(f),
        kind_(kind),
        is_movable_(is_movable),
        triangles_(packed_.world.triangle_count),
        fold_(q, kernels, t),
        blocks_(q, kernels, t) {
    const std::uint32_t largest = largest_mesh(packed_);
    if (has_trees()) trees_.emplace(q, kernels, t, kind, block_leaves).prepare(largest);
    if (has_trees() && f.instances && !packed_.instances.empty())
      over_instances_.emplace(q, kernels, t, kind, true, packed_.instances.size());
    // What planning takes of a mesh is less than what building and cutting took.
    check_memory(
        q.get_device(), triangles_,
        triangles_ * uploaded_bytes + (has_trees() ? node_trees::scratch_bytes(largest) : 0));
  }

  device_geometry build(std::span<const given_tree> given) {
    const auto start_upload = clock::now();
    for (std::uint32_t k = 0; k < packed_.meshes.size(); ++k)
      if (packed_.meshes[k].triangle_count > 0) upload(k);
    queue_.wait_and_throw();
    const double upload_ms = milliseconds_since(start_upload);

    const auto start_build = clock::now();
    for (planned_mesh& m : meshes_) plan(m, given);
    plan_instances();
    device_geometry g = allocated();
    for (planned_mesh& m : meshes_) write(m, g);
    write_instances(g);
    queue_.wait_and_throw();
    g.build_ms = milliseconds_since(start_build);
    g.upload_ms = upload_ms;
    if (trees_) trees_->add_programs(g.programs);
    fold_.add_programs(g.programs);
    blocks_.add_programs(g.programs);
    if (over_instances_) over_instances_->add_programs(g.programs);
    return g;
  }

 private:
  /// Of a triangle, until its blocks are made: corners and material.
  static constexpr std::uint64_t uploaded_bytes = 3 * sizeof(texel) + sizeof(std::uint32_t);

  bool has_trees() const { return kind_ != tree_kind::none; }
  const packed_mesh& packed(const planned_mesh& m) const { return packed_.meshes[m.mesh]; }
  std::span<const texel> corners_of(const planned_mesh& m) const {
    return std::span<const texel>(packed_.corners)
        .subspan(3 * std::size_t(packed(m).first_triangle),
                 3 * std::size_t(packed(m).triangle_count));
  }

  void upload(std::uint32_t mesh) {
    const packed_mesh& m = packed_.meshes[mesh];
    meshes_.push_back(
        {mesh,
         {&packed_.corners[3 * std::size_t(m.first_triangle)], 3 * std::size_t(m.triangle_count)},
         {&packed_.triangle_materials[m.first_triangle], m.triangle_count},
         {},
         {0, blocks_of(m.triangle_count), 0, runtime::buffer<FoldPlan>(1)}});
    // Memory moves when it is first asked for: not within the build.
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor corners{meshes_.back().corners, h, runtime::read_only};
      const runtime::accessor materials{meshes_.back().materials, h, runtime::read_only};
    });
  }

  void plan(planned_mesh& m, std::span<const given_tree> given) {
    if (has_trees()) {
      m.tree = m.mesh < given.size() ? trees_->from(given[m.mesh], corners_of(m))
                                     : trees_->over_triangles(m.corners, packed(m).triangle_count);
      m.fold = fold_.plan(m.tree);
      mesh_binary_depth_ = std::max(mesh_binary_depth_, m.tree.depth);
      mesh_depth_ = std::max(mesh_depth_, m.fold.depth);
      binary_nodes_ += m.tree.node_count;
    }
    nodes_ += m.fold.nodes;
    slots_ += m.fold.leaves * FACET_BLOCK;
    kept_scratch_ += std::uint64_t(packed(m).triangle_count) * sizeof(std::uint32_t) +
                     std::uint64_t(m.tree.node_count) * sizeof(Node) +
                     folder::kept_bytes(m.tree.node_count);
  }

  void plan_instances() {
    if (!over_instances_) return;
    top_ = over_instances_->plan(packed_.instances);
    nodes_ += is_movable_ ? top_level::most_nodes(packed_.instances.size()) : top_->nodes;
  }

  device_geometry allocated() const {
    const std::uint64_t bytes =
        nodes_ * sizeof(WideNode) +
        slots_ * (sizeof(TriangleBlock) / FACET_BLOCK + sizeof(TriangleInfo) +
                  (features_.smooth ? 3 * sizeof(texel) : 0)) +
        packed_.instances.size() * sizeof(Instance) + packed_.materials.size() * sizeof(Material);
    const std::uint64_t normals = features_.smooth ? 3 * sizeof(texel) : 0;
    check_memory(queue_.get_device(), triangles_,
                 bytes + triangles_ * (uploaded_bytes + normals) + kept_scratch_);
    const auto room = [](std::uint64_t count) { return std::max<std::uint64_t>(1, count); };
    device_geometry g{runtime::buffer<World>(1),
                      runtime::buffer<Node>(1),
                      runtime::buffer<WideNode>(room(nodes_)),
                      runtime::buffer<Instance>(1),
                      runtime::buffer<TriangleInfo>(room(slots_)),
                      runtime::buffer<Material>(packed_.materials.data(), packed_.materials.size()),
                      runtime::buffer<texel>(
                          room(slots_ / FACET_BLOCK * (sizeof(TriangleBlock) / sizeof(texel)))),
                      runtime::buffer<texel>(room(features_.smooth ? 3 * slots_ : 0)),
                      std::nullopt,
                      std::nullopt};
    g.is_wide = true;
    g.mesh_depth = mesh_binary_depth_;
    g.mesh_levels = mesh_depth_;
    g.mesh_nodes_used = binary_nodes_;
    g.meshes.resize(packed_.meshes.size());
    set_depth(g, features_.instances, top_ ? &*top_ : nullptr);
    g.bytes = bytes;
    return g;
  }

  void write(planned_mesh& m, device_geometry& to) {
    const std::uint32_t triangles = packed(m).triangle_count, first_block = next_block_;
    mesh_place& there = to.meshes[m.mesh];
    there.first_node = next_node_;
    there.nodes = m.fold.nodes;
    there.first_slot = first_block * FACET_BLOCK;
    there.slots = m.fold.leaves * FACET_BLOCK;
    block_list list{runtime::buffer<std::uint32_t>(m.fold.leaves), m.tree.order, m.fold.leaves};
    if (has_trees())
      there.root = fold_.emit(m.tree, m.fold, to.wide_nodes, next_node_, list.leaves, first_block);
    else
      list = blocks_in_order(triangles);
    blocks_.make(list, m.corners, m.materials, to.corners, to.infos, first_block);
    if (features_.smooth) {
      const runtime::buffer<texel> normals(
          &packed_.normals[3 * std::size_t(packed(m).first_triangle)], 3 * std::size_t(triangles));
      blocks_.normals(list, normals, to.normals, first_block);
    }
    next_node_ += m.fold.nodes;
    next_block_ += m.fold.leaves;
  }

  void write_instances(device_geometry& to) {
    std::vector<Instance>& placed = packed_.instances;
    for (std::size_t i = 0; i < placed.size(); ++i) {
      const mesh_place& there = to.meshes[packed_.instance_meshes[i]];
      placed[i].root = there.root;
      placed[i].first_triangle = there.first_slot;
      placed[i].triangle_count = there.slots;
    }
    if (!features_.instances) packed_.world.root = placed.empty() ? FACET_NONE : placed[0].root;
    to.first_top_node = next_node_;
    if (top_) packed_.world.root = over_instances_->write(*top_, to, next_node_, placed);
    if (!placed.empty()) to.instances = runtime::buffer<Instance>(placed.data(), placed.size());
    packed_.world.triangle_count = std::uint32_t(slots_);
    to.world = runtime::buffer<World>(&packed_.world, 1);
  }

  runtime::queue queue_;
  packed_scene packed_;
  features features_;
  tree_kind kind_;
  bool is_movable_;
  std::uint64_t triangles_;
  std::optional<node_trees> trees_;
  folder fold_;
  block_maker blocks_;
  std::vector<planned_mesh> meshes_;
  std::optional<top_level> over_instances_;
  std::optional<top_plan> top_;
  std::uint64_t nodes_ = 0, slots_ = 0, binary_nodes_ = 0, kept_scratch_ = 0;
  std::uint32_t mesh_depth_ = 0, mesh_binary_depth_ = 0;
  std::uint32_t next_node_ = 0, next_block_ = 0;
};

}  // namespace

device_geometry build_wide_geometry(runtime::queue& q, const runtime::source_tree& kernels,
                                    packed_scene packed, const features& f, tree_kind kind,
                                    const tuning& t, std::span<const given_tree> given,
                                    bool is_movable) {
  return wide_builder(q, kernels, std::move(packed), f, kind, t, is_movable).build(given);
}

}  // namespace facet::tracer
