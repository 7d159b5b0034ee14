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

/// Loads it on another thread, for which picture_files() waits: after a while, or once the other
/// function says that the driver has loaded what it takes.
void load_picture_files_soon();
void load_picture_files_now();

}  // namespace facet::cli
