#include "cli/picture_module.hpp"

#include <dlfcn.h>

#include <future>
#include <string>

namespace facet::cli {
namespace {
namespace fs = std::filesystem;

constexpr const char* file_name = "facet_pictures.so";

fs::path module_file() {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  const fs::path as_built = folder / file_name,
                 as_installed =
                     (folder / FACET_MODULES_FROM_PROGRAM / file_name).lexically_normal();
  for (const fs::path& place : {as_built, as_installed})
    if (fs::exists(place)) return place;
  throw module_error("the part of facet that reads and writes pictures, " + as_built.string() +
                     " or " + as_installed.string() +
                     ", is missing; install facet again, or use .npy");
}

const image::file_functions* load() {
  const fs::path file = module_file();
  void* const module = dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* const found = module ? dlsym(module, image::file_functions_name) : nullptr;
  if (!found)
    throw module_error(file.string() + " cannot be loaded: " + dlerror() +
                       "; install facet and OpenImageIO again, or use .npy");
  return static_cast<const image::file_functions*>(found);
}

std::shared_future<const image::file_functions*>& loading(std::launch how) {
  static std::shared_future<const image::file_functions*> module = std::async(how, load).share();
  return module;
}

}  // namespace

void check_picture_module() { module_file(); }

const image::file_functions& picture_files() { return *loading(std::launch::deferred).get(); }

void load_picture_files_soon() { loading(std::launch::async); }

}  // namespace facet::cli
