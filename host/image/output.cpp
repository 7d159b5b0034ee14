#include "image/output.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

namespace facet::image {
namespace fs = std::filesystem;
namespace {

std::string reason(int error) { return std::generic_category().message(error); }

/// Where a chain of symbolic links ends, whether or not a file is there.
fs::path follow_links(fs::path path) {
  std::error_code ignored;
  for (int step = 0; step < 40 && fs::is_symlink(path, ignored); ++step) {
    const fs::path next = fs::read_symlink(path, ignored);
    if (ignored) break;
    path = next.is_absolute() ? next : path.parent_path() / next;
  }
  return path;
}

fs::path folder_of(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path temporary_beside(const fs::path& target) {
  static std::atomic<unsigned> serial{0};
  // A name may have 255 bytes; the rest of the temporary's takes up to 40 of them.
  std::string name(".");
  name += target.filename().string().substr(0, 200);
  name.append(".").append(std::to_string(::getpid()));
  name.append("-").append(std::to_string(serial++)).append(".partial");
  return folder_of(target) / name;
}

}  // namespace

output_file::output_file(fs::path target) : target_(std::move(target)) {
  if (!target_.has_filename()) throw output_error(target_, "names a folder, not a file");
  resolved_ = follow_links(target_);
  struct stat found {};
  const bool exists = ::stat(resolved_.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) throw output_error(target_, "is a folder, not a file");
  if (exists && !S_ISREG(found.st_mode)) {
    descriptor_ = ::open(resolved_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot be written");
    return;
  }
  std::error_code ignored;
  if (!fs::is_directory(folder_of(resolved_), ignored))
    throw output_error(target_, "the folder \"" + folder_of(resolved_).string() +
                                    "\" does not exist; create it first");
  if (exists && ::access(resolved_.c_str(), W_OK) != 0) fail("cannot be written");
  temporary_ = temporary_beside(resolved_);
  descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    const int error = errno;
    temporary_.clear();
    throw output_error(target_, "no file can be made in its folder: " + reason(error));
  }
  // The new file keeps the old one's permissions; where the system refuses, the umask's stand.
  if (exists && ::fchmod(descriptor_, found.st_mode & 07777) != 0) errno = 0;
}

output_file::~output_file() { close_and_remove(); }

void output_file::fail(const std::string& doing) const {
  throw output_error(target_, doing + ": " + reason(errno));
}

void output_file::close_and_remove() noexcept {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
}

void output_file::write(const void* data, std::size_t bytes) { write_at(data, bytes, position_); }

void output_file::write_at(const void* data, std::size_t bytes, std::uint64_t offset) {
  auto* from = static_cast<const char*>(data);
  if (offset != position_ && ::lseek(descriptor_, off_t(offset), SEEK_SET) < 0)
    fail("cannot be written out of order");
  position_ = offset;
  while (bytes > 0) {
    // Linux writes at most 2 GiB a call.
    const ssize_t written = ::write(descriptor_, from, std::min<std::size_t>(bytes, 1u << 30));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("cannot be written");
    from += written, bytes -= std::size_t(written), position_ += std::uint64_t(written);
  }
}

void output_file::commit() {
  // fsync is where a network folder or a quota reports a full disk; devices refuse it.
  if (!temporary_.empty() && ::fsync(descriptor_) != 0 && errno != EINVAL)
    fail("cannot be written");
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0 && errno != EINTR) fail("cannot be written");
  if (temporary_.empty()) return;
  if (std::rename(temporary_.c_str(), resolved_.c_str()) != 0) fail("cannot be replaced");
  temporary_.clear();
}

void check_output(const fs::path& target) {
  struct stat found {};
  if (::stat(target.c_str(), &found) == 0 && !S_ISREG(found.st_mode) && !S_ISDIR(found.st_mode)) {
    // Opening a pipe and closing it again would end its reader.
    if (::access(target.c_str(), W_OK) != 0)
      throw output_error(target, "cannot be written: " + reason(errno));
    return;
  }
  output_file probe(target);
}

bool same_file(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::absolute(a).lexically_normal() == fs::absolute(b).lexically_normal() ||
         (fs::is_regular_file(a, ignored) && fs::equivalent(a, b, ignored));
}

void write_file(const fs::path& target, std::string_view content) {
  write_file(target, std::as_bytes(std::span(content)));
}

void write_file(const fs::path& target, std::span<const std::byte> content) {
  output_file file(target);
  file.write(content.data(), content.size());
  file.commit();
}

}  // namespace facet::image
