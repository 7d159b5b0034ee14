// The header of a PLY file: which elements follow, and what each holds.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace facet {

enum class ply_format { ascii, little, big };
enum class ply_scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// In bytes, in binary files.
std::size_t size_of(ply_scalar type);

struct ply_property {
  /// Of a vertex: 0 to 5 are x, y, z, nx, ny, nz. Of a face: `corners` is its list of vertices.
  static constexpr int other = 6, corners = 7;
  std::string name;
  bool is_list = false;
  ply_scalar count_type = ply_scalar::uint8;  ///< of a list's length; never float
  ply_scalar type = ply_scalar::float32;
  int role = other;
};

struct ply_element {
  std::string name;
  std::size_t count = 0;
  std::vector<ply_property> properties;
};

struct ply_header {
  ply_format format = ply_format::ascii;
  std::vector<ply_element> elements;
  bool has_normals = false;  ///< nx, ny and nz are all there
  std::size_t size = 0;      ///< in bytes; the data follow
  std::vector<std::string> notes;
};

/// Throws scene_error with the line. What it returns has one element "vertex" with x, y and z, and
/// one element "face" with one list of corners.
ply_header read_ply_header(const std::filesystem::path& path, std::string_view text);

}  // namespace facet
