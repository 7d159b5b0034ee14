#include "runtime/source_tree.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "runtime/error.hpp"

namespace facet::runtime {
namespace {

/// The first two words of a line that is a directive: "#include" and what follows.
struct directive {
  std::string_view word, rest;
};

constexpr std::string_view blanks = " \t\r";

std::string_view trim_left(std::string_view s) {
  const std::size_t at = s.find_first_not_of(blanks);
  return at == s.npos ? std::string_view() : s.substr(at);
}

directive directive_of(std::string_view line) {
  line = trim_left(line);
  if (!line.starts_with('#')) return {};
  line = trim_left(line.substr(1));
  const std::size_t end = std::min(line.find_first_of(" \t\r\"<("), line.size());
  return {line.substr(0, end), trim_left(line.substr(end))};
}

std::string_view first_word(std::string_view s) {
  return s.substr(0, std::min(s.find_first_of(" \t\r/"), s.size()));
}

/// Follows comments and literals along a line; returns whether the next one starts in a comment.
bool in_comment_after(std::string_view line, bool inside) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    const std::string_view two = line.substr(i, 2);
    if (inside) {
      if (two == "*/") inside = false, ++i;
    } else if (two == "//") {
      return false;
    } else if (two == "/*") {
      inside = true, ++i;
    } else if (line[i] == '"' || line[i] == '\'') {
      const char quote = line[i];
      for (++i; i < line.size() && line[i] != quote; ++i)
        if (line[i] == '\\') ++i;
    }
  }
  return inside;
}

std::string line_directive(std::size_t next_line, std::string_view file) {
  std::string name;
  for (char c : file) {
    if (c == '"' || c == '\\') name += '\\';
    name += c;
  }
  return "#line " + std::to_string(next_line) + " \"" + name + "\"\n";
}

class expander {
 public:
  explicit expander(const source_tree& sources) : sources_(sources) {}

  /// `conditional`: the text stands inside #if ... #endif of a file that includes it.
  void add(std::string_view file, std::string_view text, bool conditional) {
    open_.push_back(file);
    out_ += line_directive(1, file);
    bool comment = false;
    // A guard around the whole file (#ifndef X, #define X) is no condition on its includes.
    std::size_t depth = 0, guard = 0, directives = 0, number = 0;
    std::string_view guard_name;
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      ++number;
      const directive d = comment ? directive{} : directive_of(line);
      comment = in_comment_after(line, comment);
      if (!d.word.empty()) ++directives;
      if (d.word == "include" && d.rest.starts_with('"')) {
        include(file, number, d.rest.substr(1), conditional || depth > guard);
        out_ += line_directive(number + 1, file);
        continue;
      }
      if (d.word == "ifndef" && directives == 1) guard_name = first_word(d.rest);
      if (d.word == "define" && directives == 2 && first_word(d.rest) == guard_name) guard = 1;
      if (d.word.starts_with("if")) ++depth;
      if (d.word == "endif" && depth > 0) --depth;
      // Each file is taken once: the compiler need not, and warns in a main file.
      if (!(d.word == "pragma" && first_word(d.rest) == "once")) out_ += line;
      out_ += '\n';
    }
    open_.pop_back();
  }

  std::string take() { return std::move(out_); }

 private:
  void include(std::string_view from, std::size_t line, std::string_view rest, bool conditional) {
    const std::string_view name = rest.substr(0, std::min(rest.find('"'), rest.size()));
    const auto found = find(from, name);
    if (found == sources_.files.end())
      throw exception(errc::invalid, std::string(from) + ":" + std::to_string(line) +
                                         ": includes \"" + std::string(name) +
                                         "\", and there is no such file in the source tree");
    const std::string_view file = found->first;
    if (done_.contains(file) || std::find(open_.begin(), open_.end(), file) != open_.end()) return;
    if (!conditional) done_.insert(file);
    // The guard matters to a file that is named under a condition, then again.
    const std::string mark =
        "FACET_INCLUDED_" + std::to_string(std::distance(sources_.files.begin(), found));
    out_ += "#ifndef " + mark + "\n#define " + mark + "\n";
    add(file, found->second, conditional);
    out_ += "#endif\n";
  }

  std::map<std::string, std::string, std::less<>>::const_iterator find(
      std::string_view from, std::string_view name) const {
    const auto clean = [](std::string_view folder, std::string_view file) {
      return (std::filesystem::path(folder) / file).lexically_normal().generic_string();
    };
    const std::string folder = std::filesystem::path(from).parent_path().generic_string();
    const auto beside = sources_.files.find(clean(folder, name));
    return beside != sources_.files.end() ? beside : sources_.files.find(clean("", name));
  }

  const source_tree& sources_;
  std::string out_;
  std::set<std::string_view> done_;     // there whatever the conditions are
  std::vector<std::string_view> open_;  // being included, outermost first
};

}  // namespace

source_tree read_folder(const std::filesystem::path& folder) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error))
    throw exception(errc::invalid, "'" + folder.string() + "' is no folder of kernel sources");
  source_tree sources;
  std::filesystem::recursive_directory_iterator entry(folder, error), end;
  for (; !error && entry != end; entry.increment(error)) {
    const std::filesystem::path& path = entry->path();
    const bool source = path.extension() == ".cl" || path.extension() == ".h";
    if (!source || !entry->is_regular_file(error)) continue;
    std::ifstream in(path, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    if (!in) throw exception(errc::invalid, "'" + path.string() + "' cannot be read");
    sources.files.emplace(path.lexically_relative(folder).generic_string(), std::move(text));
  }
  if (error)
    throw exception(errc::invalid, "'" + folder.string() + "' cannot be read: " + error.message());
  return sources;
}

std::string expand(const source_tree& sources, std::string_view main_file) {
  const auto main = sources.files.find(main_file);
  if (main == sources.files.end()) {
    std::string there;
    for (const auto& [name, text] : sources.files) there += (there.empty() ? "" : ", ") + name;
    throw exception(errc::invalid, "no file '" + std::string(main_file) +
                                       "' in the source tree, which has " +
                                       (there.empty() ? "none" : there));
  }
  expander e(sources);
  e.add(main->first, main->second, false);
  return e.take();
}

std::string with_places(const std::string& log, std::string_view expanded) {
  // places[n - 1]: what the n-th line of the text is, after the #line directives before it.
  std::vector<std::string> places;
  std::string file = "<kernel>";
  std::size_t number = 1;
  std::istringstream lines{std::string(expanded)};
  for (std::string line; std::getline(lines, line);) {
    places.push_back(file + ":" + std::to_string(number++));
    std::istringstream words(line);
    std::string directive, name;
    std::size_t next = 0;
    if (words >> directive >> next >> name && directive == "#line" && name.size() > 2) {
      number = next;
      file = name.substr(1, name.size() - 2);
    }
  }
  constexpr std::string_view mark = "<kernel>:";
  std::string text;
  std::size_t at = 0;
  for (std::size_t found; (found = log.find(mark, at)) != std::string::npos;) {
    text += log.substr(at, found - at);
    at = found + mark.size();
    std::size_t n = 0;
    while (at < log.size() && std::isdigit(static_cast<unsigned char>(log[at])))
      n = 10 * n + std::size_t(log[at++] - '0');
    text += n >= 1 && n <= places.size() ? places[n - 1] : std::string(mark) + std::to_string(n);
  }
  return text + log.substr(at);
}

}  // namespace facet::runtime
