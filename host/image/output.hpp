// Output files that are whole or not there: written beside the target, then renamed onto it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace facet::image {

/// The message reads "PATH: reason".
class output_error : public std::runtime_error {
 public:
  output_error(const std::filesystem::path& path, const std::string& reason)
      : std::runtime_error(path.string() + ": " + reason), path_(path) {}
  const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// A file under way. Until `commit` returns, what was at the target before is still there; a file
/// that is not committed leaves nothing behind. A symbolic link is followed and stays a link. A
/// target that is no regular file (a pipe, /dev/stdout) is written in place: it has no content to
/// lose, and a rename would replace the device. Every failure is an output_error.
class output_file {
 public:
  /// Creates the temporary file in the target's folder.
  explicit output_file(std::filesystem::path target);
  ~output_file();
  output_file(const output_file&) = delete;
  output_file& operator=(const output_file&) = delete;

  void write(const void* data, std::size_t bytes);
  /// Writes at `offset` in bytes from the start; a pipe takes no such write unless it is the next.
  void write_at(const void* data, std::size_t bytes, std::uint64_t offset);
  /// Flushes to the disk and renames onto the target.
  void commit();

  const std::filesystem::path& path() const { return target_; }

 private:
  [[noreturn]] void fail(const std::string& doing) const;
  void close_and_remove() noexcept;

  std::filesystem::path target_;     ///< as given: what errors name
  std::filesystem::path resolved_;   ///< links followed
  std::filesystem::path temporary_;  ///< empty: the target is written in place
  int descriptor_ = -1;
  std::uint64_t position_ = 0;
};

/// Throws output_error unless a file could be made at `target` now. Tried, not guessed: a
/// temporary file is created beside it and removed. What is there is not touched.
void check_output(const std::filesystem::path& target);

/// Do both name one file? Compared by name where one of them is not there.
bool same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The whole file at once.
void write_file(const std::filesystem::path& target, std::string_view content);
void write_file(const std::filesystem::path& target, std::span<const std::byte> content);

}  // namespace facet::image
