// What a reader of mesh files hands back, and how it puts a mesh together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/material.hpp"
#include "scene/mesh.hpp"

namespace facet {

struct mesh_file {
  facet::mesh mesh;
  std::vector<material> materials;  ///< what mesh.materials index; empty if the file names none
  std::vector<std::string> notes;   ///< what was dropped, replaced or ignored: tell the user
};

/// Takes a file's vertices and faces as they come and makes a mesh of them that keeps the promises
/// of `mesh`: polygons become fans around their first corner, triangles with a coordinate that is
/// not finite or exceeds limits::coordinate are dropped and counted, and normals are unit. A corner
/// without a usable normal, in a mesh where some face has normals, takes its triangle's own.
class mesh_builder {
 public:
  static constexpr std::uint32_t none = 0xffffffffu;
  struct corner {
    std::uint32_t position = 0;
    std::uint32_t normal = none;
  };

  explicit mesh_builder(std::filesystem::path path);

  /// Whether triangles may use this position.
  static bool is_usable(vec3f position);

  std::vector<vec3f> positions;  ///< as read, NaN included
  std::vector<vec3f> normals;    ///< as read, of any length

  /// A polygon; those with fewer than 3 corners are counted and left out. Normals count only if
  /// every corner has one. The caller checks before `finish` that indices are in range. False, and
  /// nothing is added, beyond limits::triangles: `too_many` is what to say then.
  bool add_face(std::span<const corner> corners, std::uint32_t material);
  static std::string too_many();

  /// Throws scene_error if no triangle is left. Empties the builder; `materials` is the caller's.
  /// `first_unusable` says where the first unusable position stands, for messages.
  mesh_file finish(const std::string& first_unusable);

 private:
  void drop_unusable(mesh_file& result, const std::string& first_unusable);
  void settle_normals(mesh_file& result);

  std::filesystem::path path_;
  std::size_t faces_ = 0, thin_faces_ = 0;
  std::vector<std::uint32_t> indices_, normal_indices_, materials_;
};

}  // namespace facet
