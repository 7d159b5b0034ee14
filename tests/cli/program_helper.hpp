// Runs the real program as a user does.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace facet::test {

struct surroundings {
  /// Set in the program's environment: "NAME=VALUE". A user's own table of tuned defaults is never
  /// read: FACET_TUNING is empty, unless it or a folder that tables lie in is named here.
  std::vector<std::string> environment;
  /// RLIMIT_AS in bytes; 0: none.
  std::uint64_t address_space = 0;
  /// stderr is a terminal; its text is in `err` all the same.
  bool terminal = false;
  std::string program = FACET_PROGRAM;
};

struct outcome {
  int code = -1;   ///< exit code; -1 if a signal ended the program
  int signal = 0;  ///< the signal that ended it, or 0
  std::string out, err;
};

/// `facet` under way.
class program {
 public:
  explicit program(const std::vector<std::string>& arguments, const surroundings& s = {});
  /// Kills what still runs.
  ~program();
  program(const program&) = delete;
  program& operator=(const program&) = delete;

  /// Waits until the program handles `number` itself, or no more; false if it ended before.
  bool wait_until_handled(int number, bool handled);
  /// Waits until stderr holds `text`; false if the program ended without it.
  bool wait_for(const std::string& text);
  void send(int number) const;
  outcome wait();

 private:
  bool read_some();

  pid_t pid_ = -1;
  int err_ = -1;
  std::string err_text_;
  std::filesystem::path out_path_;
};

/// Runs it to its end.
outcome run(const std::vector<std::string>& arguments, const surroundings& s = {});

/// The program as it is where no OpenCL device is.
surroundings without_devices();
/// Is there a device to run on? (asked once)
bool has_device();
/// Whether a pseudo-terminal can be had: a bare chroot has no /dev/pts, and nothing to show there.
bool has_terminal();
/// Whether this test program is built with a sanitizer, which cannot live in little memory.
bool is_sanitized();

bool contains(const std::string& text, const std::string& part);

/// A .npy file of float32 in shape (N, 8).
void put_rays(const std::filesystem::path& path, const std::vector<float>& rows);

struct hit {
  float t, u, v;
  std::uint32_t instance, triangle;
};
/// What `facet trace` wrote; checks that the header is the documented one.
std::vector<hit> read_hits(const std::filesystem::path& path);

/// A small scene that the tests render: a red and a mirrored triangle under a light.
std::string small_scene();

}  // namespace facet::test
