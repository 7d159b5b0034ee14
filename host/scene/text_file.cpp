#include "scene/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "scene/error.hpp"

namespace facet {
namespace {

constexpr std::string_view blanks = " \t\r\n";

}  // namespace

std::string read_whole_file(const std::filesystem::path& path) {
  std::error_code ignored;
  const auto status = std::filesystem::status(path, ignored);
  if (!std::filesystem::exists(status))
    throw scene_error(path.string(), "", "there is no such file");
  if (!std::filesystem::is_regular_file(status))
    throw scene_error(path.string(), "", "this is not a regular file");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  const auto size = std::filesystem::file_size(path, ignored);
  std::string text;
  if (file && !ignored) {
    text.resize(size);
    file.read(text.data(), std::streamsize(size));
  }
  if (!file || ignored)
    throw scene_error(path.string(), "",
                      std::string("cannot be read: ") +
                          (errno ? std::strerror(errno) : "the file ended while it was read"));
  return text;
}

std::string_view take_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find_first_of("\r\n"));
  text.remove_prefix(line.size());
  if (text.starts_with("\r\n"))
    text.remove_prefix(2);
  else if (!text.empty())
    text.remove_prefix(1);
  return line;
}

std::string_view trimmed(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  return text.substr(0, text.find_last_not_of(blanks) + 1);
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (problem == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos;
    return std::copysign(tiny ? 0.0 : INFINITY, word.starts_with('-') ? -1.0 : 1.0);
  }
  if (problem != std::errc()) return std::nullopt;
  return value;
}

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

}  // namespace facet
