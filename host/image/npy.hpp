// NumPy's .npy files: one array, little-endian, in C order (NEP 1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "scene/picture.hpp"

namespace facet::image {

/// A float32 array; the last axis varies fastest.
struct float_array {
  std::vector<std::uint64_t> shape;
  std::vector<float> values;
};

/// Reads '<f4' in C order, format versions 1 to 3. Throws scene_error, naming what was found and
/// what is allowed, for any other type or order, and for a file whose size does not fit its shape
/// (checked before anything is allocated).
float_array read_npy(const std::filesystem::path& path);

/// As read_npy, of shape (N, columns): `values` holds N rows.
std::vector<float> read_npy_rows(const std::filesystem::path& path, std::uint64_t columns);

/// As read_npy, of shape (height, width, 4).
picture read_npy_picture(const std::filesystem::path& path);

/// One field of a structured array.
struct npy_field {
  std::string name, type;  ///< "t", "<f4"
};

/// Writes an array of structures; `records` holds count * the size of the fields together, without
/// padding. Throws output_error.
void write_npy(const std::filesystem::path& path, const std::vector<npy_field>& fields,
               std::uint64_t count, std::span<const std::byte> records);

/// Float32 of shape (height, width, 4), as `picture` holds it: linear, not clamped.
void write_npy(const std::filesystem::path& path, const picture& p);

}  // namespace facet::image
