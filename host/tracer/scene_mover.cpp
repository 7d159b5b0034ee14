#include "tracer/scene_mover.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include "scene/shut.hpp"
#include "scene/validate.hpp"
#include "tracer/moved_vertices.hpp"
#include "tracer/pack.hpp"
#include "tracer/stopwatch.hpp"

namespace facet::tracer {
namespace {

void check_count(const char* what, const std::string& whose, std::size_t found,
                 std::size_t allowed) {
  if (found != allowed)
    throw runtime::exception(runtime::errc::invalid,
                             std::to_string(found) + ' ' + what + " were given, and " + whose +
                                 " has " + std::to_string(allowed) + "; give one for each");
}

/// Copies what images hold into a buffer, and back.
runtime::buffer<texel> texels_of(runtime::queue& q, const runtime::image2d& image) {
  runtime::buffer<texel> b(image.width() * image.height());
  q.submit([&](runtime::handler& h) {
    h.copy(runtime::image_accessor{image, h, runtime::read_only},
           runtime::accessor{b, h, runtime::write_only});
  });
  return b;
}

void put_back(runtime::queue& q, const runtime::buffer<texel>& b, const runtime::image2d& image) {
  q.submit([&](runtime::handler& h) {
    h.copy(runtime::accessor{b, h, runtime::read_only},
           runtime::image_accessor{image, h, runtime::write_only});
  });
}

/// The host's memory must live until the queue has been waited for.
template <class T>
void upload(runtime::queue& q, const T* from, const runtime::buffer<T>& to) {
  q.submit([&](runtime::handler& h) {
    h.copy(from, runtime::accessor{to, h, runtime::write_only});
  });
}

void put_bounds(Instance& q, const instance& placed, const box3f& mesh_bounds) {
  const Instance now = pack_instance(placed, q.id, mesh_bounds);
  std::copy(std::begin(now.lo), std::end(now.lo), q.lo);
  std::copy(std::begin(now.hi), std::end(now.hi), q.hi);
  std::copy(std::begin(now.reach), std::end(now.reach), q.reach);
}

scene_mover& mover_of(device_scene::state& s) {
  if (!s.chosen.movable)
    throw runtime::exception(runtime::errc::invalid,
                             "the scene was not made to be moved; make it with options::movable");
  if (!s.mover) s.mover = std::make_shared<scene_mover>(s);
  return *s.mover;
}

}  // namespace

scene_mover::scene_mover(device_scene::state& s)
    : state_(s),
      refit_(s.queue, s.kernels, s.tuned, s.geometry.is_wide),
      corners_(s.queue, s.kernels, s.tuned, s.geometry.is_wide),
      bounds_(s.model.meshes.size()),
      uses_all_(s.model.meshes.size(), false),
      world_(runtime::host_accessor{s.geometry.world, runtime::read_only}[0]) {
  device_geometry& g = s.geometry;
  refit_.add_programs(g.programs);
  corners_.add_programs(g.programs);
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    if (g.meshes[k].slots > 0) {
      bounds_[k] = s.model.meshes[k].bounds();
      uses_all_[k] = uses_all_positions(s.model.meshes[k]);
    }
  for (std::uint32_t id = 0; id < s.model.instances.size(); ++id) {
    const instance& i = s.model.instances[id];
    const mesh_place& there = g.meshes[i.mesh];
    if (there.slots == 0) continue;
    Instance q = pack_instance(i, id, bounds_[i.mesh]);
    q.root = there.root;
    q.first_triangle = there.first_slot;
    q.triangle_count = there.slots;
    placed_.push_back(q);
  }
}

void scene_mover::move_vertices(std::uint32_t mesh, std::span<const vec3f> positions,
                                std::span<const vec3f> normals) {
  device_scene::state& s = state_;
  if (mesh >= s.model.meshes.size())
    throw runtime::exception(runtime::errc::invalid,
                             "mesh " + std::to_string(mesh) + " was to be moved; the scene has " +
                                 std::to_string(s.model.meshes.size()) + ", counted from 0");
  facet::mesh& m = s.model.meshes[mesh];
  const std::string whose = "mesh " + std::to_string(mesh);
  check_count("positions", whose, positions.size(), m.positions.size());
  if (!normals.empty()) check_count("normals", whose, normals.size(), m.normals.size());

  const auto start_upload = clock::now();
  const box3f bounds = checked_bounds(s.model, mesh, positions, normals, uses_all_[mesh]);
  for (std::size_t id = 0; id < s.model.instances.size(); ++id)
    if (s.model.instances[id].mesh == mesh)
      validate_transform(s.model.instances[id].world_from_object, bounds, id, "");
  const bool is_shown = s.geometry.meshes[mesh].slots > 0;
  if (is_shown) {
    const mesh_vertices& v = moving(mesh, !normals.empty()).vertices;
    upload(s.queue, positions.data(), v.positions);
    if (!normals.empty()) upload(s.queue, normals.data(), v.normals);
  }
  std::copy(positions.begin(), positions.end(), m.positions.begin());
  std::copy(normals.begin(), normals.end(), m.normals.begin());
  s.camera_media.reset();
  s.queue.wait_and_throw();
  s.geometry.upload_ms = milliseconds_since(start_upload);

  const auto start = clock::now();
  if (is_shown) {
    write(mesh, !normals.empty());
    bounds_[mesh] = bounds;
    for (Instance& q : placed_)
      if (s.model.instances[q.id].mesh == mesh) put_bounds(q, s.model.instances[q.id], bounds);
    write_instances();
  }
  s.geometry.build_ms = milliseconds_since(start);
}

void scene_mover::place(std::span<const transform> world_from_object) {
  device_scene::state& s = state_;
  std::vector<instance>& all = s.model.instances;
  check_count("transforms", "the scene", world_from_object.size(), all.size());
  const auto start = clock::now();
  for (std::size_t id = 0; id < all.size(); ++id)
    if (world_from_object[id] != all[id].world_from_object)
      validate_transform(world_from_object[id], bounds_[all[id].mesh], id, "");

  for (Instance& q : placed_) {
    instance& i = all[q.id];
    if (world_from_object[q.id] == i.world_from_object) continue;
    i.world_from_object = world_from_object[q.id];
    const Instance before = q;
    q = pack_instance(i, before.id, bounds_[i.mesh]);
    q.root = before.root;
    q.first_triangle = before.first_triangle;
    q.triangle_count = before.triangle_count;
  }
  if (!s.used.instances && !all[0].world_from_object.is_identity()) {
    s.used.instances = true;
    s.forget_programs();
  }
  s.camera_media.reset();
  write_instances();
  s.geometry.upload_ms = 0;
  s.geometry.build_ms = milliseconds_since(start);
}

scene_mover::moving_mesh& scene_mover::moving(std::uint32_t mesh, bool with_normals) {
  device_geometry& g = state_.geometry;
  auto at = moving_.find(mesh);
  if (at == moving_.end()) {
    at = moving_
             .try_emplace(mesh, moving_mesh{mesh_vertices(state_.model.meshes[mesh]),
                                            refit_.plan(g, g.meshes[mesh])})
             .first;
    g.bytes += at->second.vertices.indices.byte_size() + at->second.vertices.positions.byte_size() +
               at->second.plan.bytes();
  }
  moving_mesh& m = at->second;
  if (with_normals && !std::exchange(m.has_normals, true))
    g.bytes += m.vertices.normal_indices.byte_size() + m.vertices.normals.byte_size();
  return m;
}

/// Of the mesh's vertices, which are on the device: corners, boxes and, if they moved, too,
/// normals.
void scene_mover::write(std::uint32_t mesh, bool with_normals) {
  device_scene::state& s = state_;
  device_geometry& g = s.geometry;
  const mesh_place& at = g.meshes[mesh];
  const moving_mesh& m = moving_.at(mesh);
  const runtime::buffer<texel> corners =
      s.in_images ? texels_of(s.queue, *g.corner_image) : g.corners;
  corners_.write(m.vertices, g, at, {}, corners);
  refit_.refit(m.plan, g, at, corners);
  const std::vector<bool> shut = shut_of(s.model.meshes[mesh]);
  if (!shut.empty()) {
    corners_.write(m.vertices, g, at, shut, corners);
    refit_.refit(m.plan, g, at, corners);
  }
  if (s.in_images) put_back(s.queue, corners, *g.corner_image);
  if (with_normals && s.model.meshes[mesh].is_smooth()) {
    const runtime::buffer<texel> out =
        s.in_images ? texels_of(s.queue, *g.normal_image) : g.normals;
    corners_.write_normals(m.vertices, g, at, out);
    if (s.in_images) put_back(s.queue, out, *g.normal_image);
  }
}

/// As shut_triangles; empty if none is. Only those are looked at that the device is in doubt about,
/// unless one of them may close a seam.
std::vector<bool> scene_mover::shut_of(const mesh& m) {
  const auto unsure = corners_.unsure();
  if (!unsure) return shut_triangles(m);
  std::vector<bool> shut;
  for (const std::uint32_t t : *unsure) {
    const vec3f a = m.position(t, 0), b = m.position(t, 1), c = m.position(t, 2);
    if (has_area(a, b, c)) continue;
    if (a != b && b != c && c != a) return shut_triangles(m);
    shut.resize(m.triangle_count());
    shut[t] = true;
  }
  return shut;
}

/// Puts the instances on the device as they are placed, and the tree over them.
void scene_mover::write_instances() {
  device_scene::state& s = state_;
  device_geometry& g = s.geometry;
  if (placed_.empty()) return;
  std::vector<Instance> sorted = placed_;
  const bool has_top = s.used.instances && s.chosen.tree != tree_kind::none;
  const std::uint32_t stack = g.stack;
  if (has_top) {
    if (!over_instances_) {
      over_instances_.emplace(s.queue, s.kernels, s.tuned, s.chosen.tree, g.is_wide, sorted.size());
      over_instances_->add_programs(g.programs);
    }
    top_plan top = over_instances_->plan(sorted);
    world_.root = over_instances_->write(top, g, g.first_top_node, sorted);
    set_depth(g, true, &top);
  } else {
    set_depth(g, s.used.instances, nullptr);
  }
  // A stack that is larger than it need be costs less than compiling anew.
  if (g.stack > stack)
    s.forget_programs();
  else
    g.stack = stack;

  box3f bounds;
  for (const Instance& q : placed_)
    bounds.add(box3f{{q.lo[0], q.lo[1], q.lo[2]}, {q.hi[0], q.hi[1], q.hi[2]}});
  const std::array<float, 3> reach = reach_of(bounds);
  std::copy(reach.begin(), reach.end(), world_.reach);
  upload(s.queue, sorted.data(), g.instances);
  upload(s.queue, &world_, g.world);
  s.queue.wait_and_throw();
}

void device_scene::move_vertices(std::uint32_t mesh, std::span<const vec3f> positions,
                                 std::span<const vec3f> normals) {
  mover_of(*state_).move_vertices(mesh, positions, normals);
}

void device_scene::place(std::span<const transform> world_from_object) {
  mover_of(*state_).place(world_from_object);
}

}  // namespace facet::tracer
