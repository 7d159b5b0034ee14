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
#include "image/read.hpp"
#include "image/write.hpp"
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
  image::check_output(path);
}

void write_picture_file(const fs::path& path, const picture& p, image::transfer curve) {
  image::refuse_nan(p);
  if (extension_of(path) == ".npy") return image::write_npy(path, p);
#ifdef FACET_OPENIMAGEIO
  image::write_picture(path, p, curve);
#else
  static_cast<void>(curve);
  throw usage_error(path.string() + ": " + allowed);
#endif
}

picture read_picture_file(const fs::path& path, std::optional<image::transfer> curve) {
  if (extension_of(path) == ".npy") return image::read_npy_picture(path);
#ifdef FACET_OPENIMAGEIO
  return image::read_picture(path, curve);
#else
  static_cast<void>(curve);
  throw scene_error(path.string(), "", allowed);
#endif
}

}  // namespace facet::cli
