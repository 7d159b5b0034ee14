#include "cli/picture_module.hpp"

#include <dlfcn.h>

#include <chrono>
#include <future>
#include <semaphore>
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

/// Who loads a library waits for whoever does: a driver's kernels that come from its cache would
/// wait for the module. If none was loaded for so long, the driver compiles, and has the time.
constexpr std::chrono::milliseconds patience{250};

std::counting_semaphore<>& wanted() {
  static std::counting_semaphore<> is_wanted{0};
  return is_wanted;
}

std::shared_future<const image::file_functions*>& loading(std::launch how) {
  std::counting_semaphore<>& is_wanted = wanted();  // first, so that it outlives the thread
  static std::shared_future<const image::file_functions*> module =
      std::async(how, [&is_wanted] {
        static_cast<void>(is_wanted.try_acquire_for(patience));
        return load();
      }).share();
  return module;
}

}  // namespace

void check_picture_module() { module_file(); }

const image::file_functions& picture_files() {
  load_picture_files_now();
  return *loading(std::launch::deferred).get();
}

void load_picture_files_soon() { loading(std::launch::async); }

void load_picture_files_now() { wanted().release(); }

}  // namespace facet::cli
