// The module of picture files (image/files.hpp), found beside the program.
#pragma once

#include <stdexcept>

#include "image/files.hpp"

namespace facet::cli {

/// The module is missing or cannot be loaded: says which file, and what to do.
struct module_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws module_error if the module is missing.
void check_picture_module();

/// Loads the module unless that was done. Throws module_error.
const image::file_functions& picture_files();

/// Begins to load it, on another thread: picture_files() waits for that.
void load_picture_files_soon();

}  // namespace facet::cli
