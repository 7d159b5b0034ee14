// A scene as the arrays that a device reads: the only place where the two models meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.hpp"
#include "tracer/layout.hpp"

namespace facet::tracer {

using texel = std::array<float, 4>;

/// Where one mesh of the scene stands in the concatenated arrays.
struct packed_mesh {
  std::uint32_t first_triangle = 0, triangle_count = 0;
};

struct packed_scene {
  /// 3 texels a triangle, meshes one after the other in mesh order; w is 0.
  std::vector<texel> corners;
  /// The same for normals; all 0 for a flat mesh (the kernel then takes the plane's). Empty unless
  /// they were asked for.
  std::vector<texel> normals;
  std::vector<std::uint32_t> triangle_materials;  ///< 1 a triangle
  std::vector<packed_mesh> meshes;
  /// In scene order, those of meshes without triangles left out; `root` is set once the trees are
  /// built.
  std::vector<Instance> instances;
  std::vector<std::uint32_t> instance_meshes;  ///< index into `meshes`, 1 an instance
  std::vector<Material> materials;
  std::vector<Light> lights;
  World world{};
};

/// Triangles of the largest mesh.
std::uint32_t largest_mesh(const packed_scene& p);

/// The scene's instance `id`, placed over a mesh with those bounds; root and slots are left 0.
Instance pack_instance(const instance& placed, std::uint32_t id, const box3f& mesh_bounds);

/// The largest |coordinate| of a box, by axis; 0 if it is empty.
std::array<float, 3> reach_of(const box3f& b);

/// The scene must be valid (scene/validate.hpp). Meshes that no instance shows are packed as empty.
packed_scene pack(const scene& s, bool with_normals);

/// The camera and surroundings of a picture; `media` are those around the camera
/// (scene/media.hpp). Throws scene_error if the camera is degenerate.
View pack_view(const scene& s, const std::vector<std::uint32_t>& media, std::uint32_t width,
               std::uint32_t height, std::uint32_t max_depth);

}  // namespace facet::tracer
