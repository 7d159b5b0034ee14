// Errors of scenes: which file, where in it, what was found, what is allowed.
#pragma once

#include <stdexcept>
#include <string>

namespace facet {

/// The message reads "file: place: what". `place` is a line ("line 12") or a JSON pointer
/// ("/materials/2/Kd"); it may be empty.
class scene_error : public std::runtime_error {
 public:
  scene_error(const std::string& file, const std::string& place, const std::string& what)
      : std::runtime_error((file.empty() ? "" : file + ": ") + (place.empty() ? "" : place + ": ") +
                           what),
        file_(file),
        place_(place),
        message_(what) {}

  const std::string& file() const noexcept { return file_; }
  const std::string& place() const noexcept { return place_; }
  /// what() without file and place.
  const std::string& message() const noexcept { return message_; }

 private:
  std::string file_, place_, message_;
};

}  // namespace facet
