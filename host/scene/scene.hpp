// The scene model: what a picture is made of. It knows nothing of OpenCL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/material.hpp"
#include "scene/mesh.hpp"
#include "scene/transform.hpp"
#include "scene/vec.hpp"

namespace facet {

/// Hard limits, checked before anything is allocated.
namespace limits {
inline constexpr float coordinate = 1e18f;          ///< largest |position| that a mesh may have
inline constexpr std::size_t triangles = 1u << 27;  ///< in one scene, instances not multiplied
inline constexpr std::size_t instances = 1u << 24;
inline constexpr std::size_t materials = 1u << 20;
inline constexpr std::size_t lights = 1024;
inline constexpr std::size_t scene_file = 256u << 20;  ///< bytes of a .json file
inline constexpr std::uint32_t image_side = 32768;
inline constexpr std::uint32_t max_depth = 64;
inline constexpr std::uint32_t samples = 16;  ///< a side of a pixel
inline constexpr std::uint32_t nesting = 8;   ///< transparent objects within one another
}  // namespace limits

/// A pinhole camera. The picture's vertical angle is `vertical_fov`; x grows to the right.
struct camera {
  vec3d position{0, 0, 5};
  vec3d look_at{0, 0, 0};
  vec3d up{0, 1, 0};
  double vertical_fov = 40;  ///< degrees, between 0 and 180, both excluded
};

/// Rays of a picture: through the point (x, y) in pixels, y down, goes
/// origin + s * normalize(corner + x * dx + y * dy). Pixel (i, j) has its centre at (i+.5, j+.5).
struct camera_frame {
  vec3d origin, corner, dx, dy;
};

/// Throws scene_error if the camera is degenerate (look_at on position, up along the view).
camera_frame frame_of(const camera& c, std::uint32_t width, std::uint32_t height);

struct light {
  enum class kind { point, directional };
  kind type = kind::point;
  vec3d position;   ///< point lights
  vec3d direction;  ///< directional lights: the way the light travels, any length but 0
  vec3f colour{1, 1, 1};
  /// f(d) = min(1, 1 / (constant + linear * d + quadratic * d^2)); point lights only.
  float constant = 1, linear = 0, quadratic = 0;
};

/// A mesh placed in the world.
struct instance {
  static constexpr std::uint32_t own_materials = 0xffffffffu;
  std::uint32_t mesh = 0;
  transform world_from_object;
  std::uint32_t material = own_materials;  ///< replaces the mesh's materials unless own_materials
};

struct scene {
  std::string name;
  camera view;
  std::uint32_t width = 800, height = 600;  ///< the picture's size unless told otherwise
  std::uint32_t max_depth = 5;  ///< bounces: 0 traces eye rays (and their shadows) alone
  std::uint32_t samples = 1;    ///< a side of the regular grid in a pixel: n means n*n rays
  /// How many transparent objects a point may lie in at once; 1: none lies within another. Light is
  /// bent as if the innermost displaced the others, and dimmed by all. A ray that enters more
  /// forgets the outermost, and is counted.
  std::uint32_t nesting = 1;
  vec3f ambient{0, 0, 0};  ///< Ia
  vec3f background{0, 0, 0};
  float background_alpha = 1;
  std::vector<material> materials;  ///< never empty in a valid scene
  std::vector<facet::mesh> meshes;
  std::vector<instance> instances;
  std::vector<light> lights;
  /// The materials of the transparent objects around the camera, innermost first, where the meshes
  /// do not tell them any more (placed.hpp).
  std::optional<std::vector<std::uint32_t>> around_camera;
  std::vector<std::string> notes;  ///< what the reader made up, dropped or ignored: tell the user

  std::size_t triangle_count() const {
    std::size_t n = 0;
    for (const auto& m : meshes) n += m.triangle_count();
    return n;
  }
  /// Of all instances: what a ray is tested against without a tree.
  std::uint64_t placed_triangle_count() const {
    std::uint64_t n = 0;
    for (const auto& i : instances) n += meshes[i.mesh].triangle_count();
    return n;
  }
};

}  // namespace facet
