#include "scene/ply_header.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>

#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "scene/text_file.hpp"

namespace facet {
namespace {

/// Two names each, the old and the new, in the order of ply_scalar.
constexpr const char* scalar_names[] = {"char",   "int8",    "uchar",  "uint8",  "short", "int16",
                                        "ushort", "uint16",  "int",    "int32",  "uint",  "uint32",
                                        "float",  "float32", "double", "float64"};

class header_reader {
 public:
  header_reader(const std::filesystem::path& path, std::string_view text)
      : path_(path), text_(text), rest_(text) {}

  ply_header read() {
    if (trimmed(next_line()) != "ply") fail("a PLY file begins with the line \"ply\"");
    read_format();
    for (;;) {
      if (rest_.empty()) fail("the file ends before the header does: there is no \"end_header\"");
      std::string_view words = next_line();
      const std::string_view keyword = take_word(words);
      if (keyword == "end_header") break;
      if (keyword == "element")
        read_element(words);
      else if (keyword == "property")
        read_property(words);
      else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty())
        fail("found " + in_quotes(keyword) +
             "; allowed are element, property, comment, obj_info and end_header");
    }
    check();
    header_.size = text_.size() - rest_.size();
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw scene_error(path_.string(), "line " + std::to_string(line_), what);
  }

  std::string_view next_line() {
    ++line_;
    return take_line(rest_);
  }

  void read_format() {
    std::string_view words;
    std::string_view keyword = "comment";
    while (keyword == "comment" || keyword == "obj_info") {
      if (rest_.empty()) fail("the file ends before its format is given");
      words = next_line();
      keyword = take_word(words);
    }
    const std::string_view format = take_word(words), version = take_word(words);
    if (format == "ascii")
      header_.format = ply_format::ascii;
    else if (format == "binary_little_endian")
      header_.format = ply_format::little;
    else if (format == "binary_big_endian")
      header_.format = ply_format::big;
    else
      fail(
          "no format that is known; allowed are \"format ascii 1.0\", binary_little_endian and "
          "binary_big_endian");
    if (keyword != "format" || version != "1.0")
      fail("found " + in_quotes(keyword) + " and version " + in_quotes(version) +
           "; allowed is \"format\" with version 1.0");
  }

  void read_element(std::string_view words) {
    ply_element e;
    e.name = std::string(take_word(words));
    const std::string_view count = take_word(words);
    const auto [end, problem] = std::from_chars(count.data(), count.data() + count.size(), e.count);
    if (count.empty() || problem != std::errc() || end != count.data() + count.size())
      fail("found " + in_quotes(count) + " as the count of element " + in_quotes(e.name) +
           "; allowed is a whole number from 0");
    if (find(e.name)) fail("there are two elements " + in_quotes(e.name) + "; one is allowed");
    header_.elements.push_back(std::move(e));
  }

  void read_property(std::string_view words) {
    if (header_.elements.empty()) fail("a property stands before the first element");
    ply_element& element = header_.elements.back();
    ply_property p;
    std::string_view type = take_word(words);
    if (type == "list") {
      p.is_list = true;
      p.count_type = scalar_named(take_word(words));
      type = take_word(words);
      if (is_float(p.count_type)) fail("the length of a list is no whole number");
    }
    p.type = scalar_named(type);
    p.name = std::string(take_word(words));
    if (p.name.empty()) fail("a property without a name");
    p.role = role_of(element, p);
    if (p.role != ply_property::other && has_role(element, p.role))
      fail("element " + in_quotes(element.name) + " has the property " + in_quotes(p.name) +
           " twice; once is allowed");
    element.properties.push_back(std::move(p));
  }

  ply_scalar scalar_named(std::string_view name) const {
    const auto found = std::find(std::begin(scalar_names), std::end(scalar_names), name);
    if (found == std::end(scalar_names))
      fail(unknown_name("type", name, {std::begin(scalar_names), std::end(scalar_names)}));
    return ply_scalar((found - std::begin(scalar_names)) / 2);
  }

  int role_of(const ply_element& e, const ply_property& p) const {
    if (e.name == "face" && (p.name == "vertex_indices" || p.name == "vertex_index")) {
      if (!p.is_list || is_float(p.type)) fail(in_quotes(p.name) + " is no list of whole numbers");
      return ply_property::corners;
    }
    const char* const names[] = {"x", "y", "z", "nx", "ny", "nz"};
    const auto found = std::find(std::begin(names), std::end(names), p.name);
    if (e.name != "vertex" || p.is_list || found == std::end(names)) return ply_property::other;
    return int(found - std::begin(names));
  }

  static bool is_float(ply_scalar type) {
    return type == ply_scalar::float32 || type == ply_scalar::float64;
  }
  static bool has_role(const ply_element& e, int role) {
    return std::any_of(e.properties.begin(), e.properties.end(),
                       [&](const ply_property& p) { return p.role == role; });
  }
  const ply_element* find(std::string_view name) const {
    for (const ply_element& e : header_.elements)
      if (e.name == name) return &e;
    return nullptr;
  }

  void check() {
    const ply_element* vertex = find("vertex");
    const ply_element* face = find("face");
    if (!vertex || !has_role(*vertex, 0) || !has_role(*vertex, 1) || !has_role(*vertex, 2))
      fail("the header has no element \"vertex\" with the properties x, y and z");
    if (!face || !has_role(*face, ply_property::corners))
      fail(
          "the header has no element \"face\" with the list vertex_indices or vertex_index: "
          "points alone, and triangle strips, are not offered");
    if (vertex->count >= 0xffffffffu)
      fail("found " + std::to_string(vertex->count) + " vertices; allowed are at most 4294967294");
    header_.has_normals = has_role(*vertex, 3) && has_role(*vertex, 4) && has_role(*vertex, 5);
    for (const ply_element* e : {vertex, face})
      if (std::any_of(e->properties.begin(), e->properties.end(),
                      [](const ply_property& p) { return p.name == "red"; }))
        header_.notes.push_back(path_.filename().string() + ": the colours of element " +
                                in_quotes(e->name) + " are not offered and ignored");
  }

  std::filesystem::path path_;
  std::string_view text_, rest_;
  std::size_t line_ = 0;
  ply_header header_;
};

}  // namespace

std::size_t size_of(ply_scalar type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[std::size_t(type)];
}

ply_header read_ply_header(const std::filesystem::path& path, std::string_view text) {
  return header_reader(path, text).read();
}

}  // namespace facet
