// Picture files as a module that is loaded where one is read or written: OpenImageIO brings some
// 250 libraries with it, and 0.3 s at each start of a program that is linked to it.
#pragma once

#include <filesystem>
#include <optional>

#include "image/transfer.hpp"
#include "scene/picture.hpp"

namespace facet::image {

/// read.hpp's and write.hpp's functions.
struct file_functions {
  picture (*read)(const std::filesystem::path& path, std::optional<transfer> curve);
  void (*write)(const std::filesystem::path& path, const picture& p, transfer curve);
};

/// The module's only symbol, of C linkage, is a `const file_functions` of this name.
inline constexpr const char* file_functions_name = "facet_picture_files";

}  // namespace facet::image
