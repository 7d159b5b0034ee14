#include "cli/picture_file.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

#include "cli/options.hpp"
#include "image/npy.hpp"
#include "image/output.hpp"
#include "scene/error.hpp"

#ifdef FACET_OPENIMAGEIO
#include "cli/picture_module.hpp"
#endif

namespace facet::cli {
namespace fs = std::filesystem;
namespace {

#ifdef FACET_OPENIMAGEIO
const std::vector<std::string> written{".png", ".exr", ".npy"};
constexpr const char* allowed = ".png, .exr and .npy are allowed";
#else
const std::vector<std::string> written{".npy"};
constexpr const char* allowed =
    ".npy is allowed; .png and .exr need a facet built with OpenImageIO (FACET_OPENIMAGEIO=ON)";
#endif

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

}  // namespace

void check_picture_output(const fs::path& path) {
  const std::string extension = extension_of(path);
  std::error_code ignored;
  if (std::find(written.begin(), written.end(), extension) == written.end()) {
    if (fs::exists(path, ignored) && fs::is_other(path, ignored))
      throw image::output_error(path, std::string("is a device or a pipe, whose name does not say "
                                                  "which kind of picture it takes; give a link to "
                                                  "it with an extension: ") +
                                          allowed);
    throw usage_error("-o " + path.string() + ": found " +
                      (extension.empty() ? "no extension" : "the extension \"" + extension + "\"") +
                      "; " + allowed);
  }
#ifdef FACET_OPENIMAGEIO
  try {
    if (extension != ".npy") check_picture_module();
  } catch (const module_error& e) {
    throw image::output_error(path, e.what());
  }
#endif
  image::check_output(path);
}

void prepare_to_write(const fs::path& path) {
#ifdef FACET_OPENIMAGEIO
  if (extension_of(path) != ".npy") load_picture_files_soon();
#else
  static_cast<void>(path);
#endif
}

void prepare_at_once() {
#ifdef FACET_OPENIMAGEIO
  load_picture_files_now();
#endif
}

void write_picture_file(const fs::path& path, const picture& p, image::transfer curve) {
  image::refuse_nan(p);
  if (extension_of(path) == ".npy") return image::write_npy(path, p);
#ifdef FACET_OPENIMAGEIO
  try {
    picture_files().write(path, p, curve);
  } catch (const module_error& e) {
    throw image::output_error(path, e.what());
  }
#else
  static_cast<void>(curve);
  throw usage_error(path.string() + ": " + allowed);
#endif
}

picture read_picture_file(const fs::path& path, std::optional<image::transfer> curve) {
  if (extension_of(path) == ".npy") return image::read_npy_picture(path);
#ifdef FACET_OPENIMAGEIO
  try {
    return picture_files().read(path, curve);
  } catch (const module_error& e) {
    throw scene_error(path.string(), "", e.what());
  }
#else
  static_cast<void>(curve);
  throw scene_error(path.string(), "", allowed);
#endif
}

}  // namespace facet::cli
