// The text of an OBJ file while a reader goes through it, so that its lines can be looked at again.
#pragma once

#include <algorithm>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "scene/text_file.hpp"

namespace facet {

/// A stream buffer over text in memory that knows how far it has been read. Lines end with LF,
/// CR LF or CR; a backslash before the end continues a line on the next, which is undone here.
class obj_text : public std::streambuf {
 public:
  explicit obj_text(std::string text) : text_(std::move(text)) {
    join_continued_lines();
    setg(text_.data(), text_.data(), text_.data() + text_.size());
  }
  obj_text(const obj_text&) = delete;

  /// How much was read: inside tinyobj's callbacks, the end of the line at hand.
  std::size_t offset() const { return std::size_t(gptr() - eback()); }

  /// The line that ends at `end`, without its end.
  std::string_view line_before(std::size_t end) const {
    const std::string_view text(text_);
    if (end > 0 && text[end - 1] == '\n') --end;
    if (end > 0 && text[end - 1] == '\r') --end;
    const std::size_t before = end == 0 ? text.npos : text.find_last_of("\r\n", end - 1);
    const std::size_t begin = before == text.npos ? 0 : before + 1;
    return text.substr(begin, end - begin);
  }
  std::string_view line() const { return line_before(offset()); }

  /// "line 12": the number in the file of the line that ends at `end`, continued ones counted.
  std::string line_name(std::size_t end) const {
    const auto begin = std::size_t(line_before(end).data() - text_.data());
    std::size_t number =
        1 + std::size_t(std::lower_bound(joined_.begin(), joined_.end(), begin) - joined_.begin());
    for (std::string_view rest(text_.data(), begin); !rest.empty(); ++number) take_line(rest);
    return "line " + std::to_string(number);
  }

 private:
  void join_continued_lines() {
    for (std::size_t i = text_.find('\\'); i != text_.npos; i = text_.find('\\', i + 1)) {
      std::size_t end = i + 1;
      if (end < text_.size() && text_[end] == '\r') ++end;
      if (end < text_.size() && text_[end] == '\n') ++end;
      if (end == i + 1) continue;
      std::fill(text_.begin() + std::ptrdiff_t(i), text_.begin() + std::ptrdiff_t(end), ' ');
      joined_.push_back(i);
    }
  }

  std::string text_;
  std::vector<std::size_t> joined_;  // where lines were joined, ascending
};

}  // namespace facet
