// A folder for the files of one test case, and the error that a call throws.
#pragma once

#include <doctest/doctest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "scene/error.hpp"

namespace facet::test {

/// A new empty folder, removed with all that is in it at the end of the scope.
class scratch_folder {
 public:
  scratch_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "facet-test-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("cannot make the folder " + name);
    path_ = name;
  }
  ~scratch_folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  scratch_folder(const scratch_folder&) = delete;
  scratch_folder& operator=(const scratch_folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, folders on the way included, and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << bytes;
    return file;
  }

 private:
  std::filesystem::path path_;
};

/// The scene_error that `call` throws; the test case fails if it throws none.
template <class Call>
scene_error error_of(const Call& call) {
  try {
    call();
  } catch (const scene_error& e) {
    return e;
  }
  FAIL_CHECK("no scene_error was thrown");
  return scene_error("", "", "none was thrown");
}

inline bool contains(const std::string& text, const std::string& part) {
  const bool found = text.find(part) != std::string::npos;
  if (!found) MESSAGE("\"" << text << "\" does not hold \"" << part << "\"");
  return found;
}

}  // namespace facet::test
