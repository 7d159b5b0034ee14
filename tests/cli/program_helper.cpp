#include "cli/program_helper.hpp"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <thread>

#include "image/temporary_folder.hpp"

namespace facet::test {
namespace {

namespace fs = std::filesystem;

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> p;
  for (std::string& t : texts) p.push_back(t.data());
  p.push_back(nullptr);
  return p;
}

/// The inherited environment with `added` before it: the first of a name wins in getenv, and
/// names set twice are dropped.
std::vector<std::string> environment_with(const std::vector<std::string>& added) {
  std::vector<std::string> all = added;
  const bool names_table = std::any_of(added.begin(), added.end(), [](const std::string& a) {
    return a.starts_with("FACET_TUNING=") || a.starts_with("XDG_CONFIG_HOME=");
  });
  if (!names_table) all.push_back("FACET_TUNING=");
  for (char** e = environ; *e; ++e) {
    const std::string name = std::string(*e).substr(0, std::string(*e).find('=') + 1);
    bool replaced = name == "FACET_TUNING=";
    for (const std::string& a : added) replaced |= a.compare(0, name.size(), name) == 0;
    if (!replaced) all.push_back(*e);
  }
  return all;
}

}  // namespace

program::program(const std::vector<std::string>& arguments, const surroundings& s) {
  std::string name = (fs::temp_directory_path() / "facet-out-XXXXXX").string();
  const int out = ::mkostemp(name.data(), O_CLOEXEC);
  REQUIRE(out >= 0);
  out_path_ = name;
  int channel[2] = {-1, -1};
  if (s.terminal)
    REQUIRE(::openpty(&channel[0], &channel[1], nullptr, nullptr, nullptr) == 0);
  else
    REQUIRE(::pipe2(channel, O_CLOEXEC) == 0);

  std::vector<std::string> words{s.program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> variables = environment_with(s.environment);
  const std::vector<char*> argv = pointers(words), envp = pointers(variables);
  // Closed by execve: until then the child has this program's signal handlers.
  int started[2] = {-1, -1};
  REQUIRE(::pipe2(started, O_CLOEXEC) == 0);
  pid_ = ::fork();
  REQUIRE(pid_ >= 0);
  if (pid_ == 0) {
    ::dup2(out, STDOUT_FILENO);
    ::dup2(channel[1], STDERR_FILENO);
    if (s.address_space) {
      const rlimit limit{s.address_space, s.address_space};
      ::setrlimit(RLIMIT_AS, &limit);
    }
    ::execve(s.program.c_str(), argv.data(), envp.data());
    ::_exit(127);
  }
  ::close(out);
  ::close(channel[1]);
  ::close(started[1]);
  char none = 0;
  REQUIRE(::read(started[0], &none, 1) == 0);
  ::close(started[0]);
  err_ = channel[0];
}

program::~program() {
  if (pid_ > 0) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  if (err_ >= 0) ::close(err_);
  std::error_code ignored;
  fs::remove(out_path_, ignored);
}

bool program::read_some() {
  char block[4096];
  const ssize_t count = ::read(err_, block, sizeof block);
  if (count > 0) err_text_.append(block, std::size_t(count));
  return count > 0;  // a terminal's end is an error (EIO), a pipe's is 0
}

bool program::wait_until_handled(int number, bool handled) {
  const std::string path = "/proc/" + std::to_string(pid_) + "/status";
  for (;;) {
    const std::string status = content_of(path);
    if (contains(status, "State:\tZ") || status.empty()) return false;
    // proc(5): a mask in hexadecimal, the lowest bit for signal 1.
    const std::size_t at = status.find("SigCgt:\t");
    const auto mask = std::stoull(status.substr(at + 8, 16), nullptr, 16);
    if (((mask >> (number - 1)) & 1) == (handled ? 1u : 0u)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

bool program::wait_for(const std::string& text) {
  while (!contains(err_text_, text))
    if (!read_some()) return false;
  return true;
}

void program::send(int number) const { ::kill(pid_, number); }

outcome program::wait() {
  while (read_some()) {
  }
  int status = 0;
  REQUIRE(::waitpid(pid_, &status, 0) == pid_);
  pid_ = -1;
  outcome o;
  o.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  o.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  o.out = content_of(out_path_);
  o.err = err_text_;
  return o;
}

outcome run(const std::vector<std::string>& arguments, const surroundings& s) {
  return program(arguments, s).wait();
}

surroundings without_devices() { return {{"OCL_ICD_VENDORS=/nonexistent"}, 0, false}; }

bool has_device() {
  static const bool found = run({"devices"}).code == 0;
  if (!found) MESSAGE("no OpenCL device: left out");
  return found;
}

bool has_terminal() {
  int ends[2];
  if (::openpty(&ends[0], &ends[1], nullptr, nullptr, nullptr) != 0) {
    MESSAGE("no pseudo-terminal (is /dev/pts mounted?): what a terminal shows is not tested");
    return false;
  }
  ::close(ends[0]);
  ::close(ends[1]);
  return true;
}

bool is_sanitized() {
#if defined(__SANITIZE_ADDRESS__)
  return true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  return true;
#else
  return false;
#endif
#else
  return false;
#endif
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

void put_rays(const fs::path& path, const std::vector<float>& rows) {
  std::string header = "{'descr': '<f4', 'fortran_order': False, 'shape': (" +
                       std::to_string(rows.size() / 8) + ", 8), }";
  header.resize(117, ' ');
  header += '\n';
  std::string file("\x93NUMPY\x01\x00\x76\x00", 10);
  file += header;
  const std::size_t start = file.size();
  file.resize(start + rows.size() * 4);
  if (!rows.empty()) std::memcpy(file.data() + start, rows.data(), rows.size() * 4);
  put(path, file);
}

std::vector<hit> read_hits(const fs::path& path) {
  const std::string file = content_of(path);
  REQUIRE(file.size() >= 10);
  const auto length = std::size_t(static_cast<unsigned char>(file[8])) +
                      256 * std::size_t(static_cast<unsigned char>(file[9]));
  const std::string header = file.substr(10, length);
  CHECK(contains(header,
                 "[('t', '<f4'), ('u', '<f4'), ('v', '<f4'), ('instance', '<u4'), "
                 "('triangle', '<u4')]"));
  const std::size_t count = (file.size() - 10 - length) / sizeof(hit);
  CHECK(contains(header, "'shape': (" + std::to_string(count) + ",)"));
  std::vector<hit> hits(count);
  if (count) std::memcpy(hits.data(), file.data() + 10 + length, count * sizeof(hit));
  return hits;
}

std::string small_scene() {
  return R"({
    "camera": {"position": [0, 1, 4], "look_at": [0, 0.5, 0], "vertical_fov": 40},
    "picture": {"width": 48, "height": 32, "max_depth": 3},
    "ambient": 0.2,
    "background": [0.1, 0.2, 0.4],
    "materials": {"red": {"Kd": [0.8, 0.1, 0.1], "Ka": 1}, "mirror": {"Kd": 0.1, "Kr": 0.8}},
    "meshes": {
      "ball": {"generate": "icosphere", "subdivisions": 2, "radius": 0.5, "smooth": 1,
               "material": "red"},
      "floor": {"generate": "plane", "size": 6, "material": "mirror"}
    },
    "instances": [
      {"mesh": "ball", "transform": [{"translate": [0, 0.6, 0]}]},
      {"mesh": "floor"}
    ],
    "lights": [{"type": "point", "position": [2, 4, 3], "colour": 0.9}]
  })";
}

}  // namespace facet::test
