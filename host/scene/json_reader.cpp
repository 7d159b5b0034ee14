#include "scene/json_reader.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <system_error>
#include <unordered_set>
#include <utility>

#include "scene/error.hpp"
#include "scene/nearest.hpp"
#include "scene/place.hpp"
#include "scene/scene.hpp"

namespace facet {
namespace {

using nlohmann::json;

constexpr std::size_t deepest_nesting = 64;

/// Watches the parser pass: refuses a repeated key and too deep a nesting, and knows at each
/// moment which place is being read.
class parse_watch {
 public:
  explicit parse_watch(const std::string& file) : file_(file) {}

  void see(json::parse_event_t event, const json& parsed) {
    switch (event) {
      case json::parse_event_t::key:
        see_key(parsed.get_ref<const std::string&>());
        break;
      case json::parse_event_t::object_start:
      case json::parse_event_t::array_start:
        if (levels_.size() == deepest_nesting)
          throw scene_error(file_, place(), "nests more than 64 arrays and objects in each other");
        levels_.push_back({event == json::parse_event_t::array_start, 0, {}, {}});
        break;
      case json::parse_event_t::object_end:
      case json::parse_event_t::array_end:
        levels_.pop_back();
        see_end_of_value();
        break;
      case json::parse_event_t::value:
        see_end_of_value();
        break;
    }
  }

  std::string place() const {
    std::string result;
    for (const level& l : levels_) {
      if (l.is_array)
        result = place_in(result, l.index);
      else if (!l.seen.empty())
        result = place_in(result, l.key);
    }
    return result;
  }

 private:
  struct level {
    bool is_array;
    std::size_t index;  ///< of the element that is being read
    std::string key;    ///< the last one read
    std::unordered_set<std::string> seen;
  };

  void see_key(const std::string& key) {
    level& l = levels_.back();
    l.key = key;
    if (!l.seen.insert(key).second)
      throw scene_error(file_, place(),
                        "the key " + in_quotes(key) + " is given twice; keep one of the two");
  }

  void see_end_of_value() {
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
  }

  const std::string& file_;
  std::vector<level> levels_;
};

std::string bytes_of(const std::filesystem::path& path, const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) throw scene_error(file, "", "there is no such file");
  if (std::filesystem::is_directory(path, ignored))
    throw scene_error(file, "", "is a folder; a scene file is expected");
  const auto check_size = [&](std::uintmax_t size) {
    if (size > limits::scene_file)
      throw scene_error(file, "",
                        "is larger than a scene file may be (" +
                            std::to_string(limits::scene_file >> 20) +
                            " MiB); put large meshes into .ply files and name them in the scene");
  };
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (!ignored) check_size(size);

  std::ifstream stream(path, std::ios::binary);
  std::string bytes;
  std::vector<char> block(1 << 16);
  while (stream.read(block.data(), std::streamsize(block.size())), stream.gcount() > 0) {
    bytes.append(block.data(), std::size_t(stream.gcount()));
    check_size(bytes.size());
  }
  if (!stream.eof()) throw scene_error(file, "", "cannot be read; are you allowed to read it?");
  return bytes;
}

/// nlohmann's "[json.exception...] parse error at line 1, column 5: syntax error ..." in two parts.
[[noreturn]] void throw_syntax_error(const std::string& file, std::string message) {
  std::string place;
  if (const auto bracket = message.find("] "); bracket != std::string::npos)
    message.erase(0, bracket + 2);
  const auto line = message.find("line "), colon = message.find(": ");
  if (line != std::string::npos && colon != std::string::npos && line < colon) {
    place = message.substr(line, colon - line);
    message.erase(0, colon + 2);
  }
  if (message.find("/'", message.find("last read")) != std::string::npos)
    message += " (JSON has no comments)";
  throw scene_error(file, place, "is not JSON: " + message);
}

std::string described(const json& value) {
  switch (value.type()) {
    case json::value_t::array:
      return "an array of " + std::to_string(value.size());
    case json::value_t::object:
      return "an object";
    case json::value_t::string:
      return "the text " + in_quotes(value.get_ref<const std::string&>());
    default:
      return value.dump();
  }
}

std::string number_text(double v) { return json(v).dump(); }

}  // namespace

json_document read_json_document(const std::filesystem::path& path) {
  json_document document{path.string(), {}};
  const std::string bytes = bytes_of(path, document.file);
  parse_watch watch(document.file);
  try {
    document.root = json::parse(bytes, [&](int, json::parse_event_t event, json& parsed) {
      watch.see(event, parsed);
      return true;
    });
  } catch (const json::parse_error& e) {
    throw_syntax_error(document.file, e.what());
  } catch (const json::out_of_range&) {
    throw scene_error(document.file, watch.place(),
                      "is a number that is too large for a double (about 1.8e308)");
  }
  return document;
}

json_node::json_node(const json_document& document) : json_node(document, document.root, "") {}

json_node::json_node(const json_document& document, const json& value, std::string place)
    : document_(&document), value_(&value), place_(std::move(place)) {}

void json_node::fail(const std::string& what) const {
  throw scene_error(document_->file, place_, what);
}

void json_node::expected(const std::string& allowed) const {
  fail("expected " + allowed + ", found " + described(*value_));
}

void json_node::check_keys(const std::string& what, const std::vector<std::string>& known) const {
  if (!value_->is_object()) expected(what + ", which is an object");
  for (const auto& [key, value] : value_->items())
    if (std::find(known.begin(), known.end(), key) == known.end())
      throw scene_error(document_->file, place_in(place_, key),
                        "in " + what + ' ' + unknown_name("key", key, known));
}

std::vector<std::string> json_node::keys() const {
  std::vector<std::string> result;
  for (const auto& [key, value] : value_->items()) result.push_back(key);
  return result;
}

json_node json_node::at(const std::string& key, const std::string& allowed) const {
  const auto member = value_->find(key);
  if (member == value_->end())
    fail("the key " + in_quotes(key) + " is missing; it holds " + allowed);
  return {*document_, *member, place_in(place_, key)};
}

std::optional<json_node> json_node::find(const std::string& key) const {
  const auto member = value_->find(key);
  if (member == value_->end()) return std::nullopt;
  return json_node(*document_, *member, place_in(place_, key));
}

std::size_t json_node::size(const std::string& allowed) const {
  if (!value_->is_array()) expected(allowed);
  return value_->size();
}

json_node json_node::element(std::size_t index) const {
  return {*document_, (*value_)[index], place_in(place_, index)};
}

bool json_node::boolean() const {
  if (!value_->is_boolean()) expected("true or false");
  return value_->get<bool>();
}

double json_node::number() const {
  if (!value_->is_number()) expected("a number");
  return value_->get<double>();
}

float json_node::narrowed(double v) const {
  if (std::abs(v) > double(std::numeric_limits<float>::max()))
    fail("is " + number_text(v) + "; a number here may be at most 3.4e38 in size");
  return float(v);
}

float json_node::single() const { return narrowed(number()); }

std::uint32_t json_node::whole(std::uint32_t least, std::uint32_t most) const {
  const std::string first = std::to_string(least);
  const std::string allowed =
      least == most ? first : "a whole number from " + first + " to " + std::to_string(most);
  if (!value_->is_number()) expected(allowed);
  const double v = value_->get<double>();
  if (!(v >= least && v <= most) || v != std::floor(v)) expected(allowed);
  return std::uint32_t(v);
}

std::string json_node::text(const std::string& allowed) const {
  if (!value_->is_string()) expected(allowed);
  const auto& result = value_->get_ref<const std::string&>();
  if (result.find('\0') != std::string::npos) fail("holds a character with code 0");
  return result;
}

std::vector<double> json_node::numbers(std::initializer_list<std::size_t> lengths,
                                       const std::string& allowed) const {
  if (!value_->is_array() ||
      std::find(lengths.begin(), lengths.end(), value_->size()) == lengths.end())
    expected(allowed);
  std::vector<double> result;
  for (std::size_t i = 0; i < value_->size(); ++i) {
    if (!(*value_)[i].is_number()) element(i).expected("a number");
    result.push_back((*value_)[i].get<double>());
  }
  return result;
}

vec3d json_node::vector() const {
  const std::vector<double> v = numbers({3}, "3 numbers, [x, y, z]");
  return {v[0], v[1], v[2]};
}

vec3f json_node::colour() const {
  if (value_->is_number()) {
    const float grey = single();
    return {grey, grey, grey};
  }
  const std::vector<double> v =
      numbers({3}, "a colour: 3 numbers, [red, green, blue], or one for all three");
  return {narrowed(v[0]), narrowed(v[1]), narrowed(v[2])};
}

}  // namespace facet
