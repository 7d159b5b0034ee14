// A scene on a device that moves: device_scene::move_vertices and place.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "tracer/moved_corners.hpp"
#include "tracer/refit.hpp"
#include "tracer/state.hpp"
#include "tracer/top_level.hpp"

namespace facet::tracer {

/// Keeps what a move needs of the one before.
class scene_mover {
 public:
  /// The state must live as long; its model has the scene's meshes.
  explicit scene_mover(device_scene::state& s);

  void move_vertices(std::uint32_t mesh, std::span<const vec3f> positions,
                     std::span<const vec3f> normals);
  void place(std::span<const transform> world_from_object);

 private:
  /// A mesh that has moved.
  struct moving_mesh {
    mesh_vertices vertices;
    refit_plan plan;
    bool has_normals = false;  ///< they have moved, too
  };

  moving_mesh& moving(std::uint32_t mesh, bool with_normals);
  void write(std::uint32_t mesh, bool with_normals);
  std::vector<bool> shut_of(const mesh& m);
  void write_instances();

  device_scene::state& state_;
  refitter refit_;
  corner_mover corners_;
  std::optional<top_level> over_instances_;
  std::map<std::uint32_t, moving_mesh> moving_;  ///< by mesh of the scene
  std::vector<box3f> bounds_;                    ///< of meshes that are shown
  std::vector<bool> uses_all_;    ///< whether a mesh's triangles use all its positions
  std::vector<Instance> placed_;  ///< those that are on the device, in scene order
  World world_;
};

}  // namespace facet::tracer
