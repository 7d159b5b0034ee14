// JSON with places: typed access whose errors name the file, the JSON pointer, what was found and
// what is allowed. It knows nothing of scenes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/vec.hpp"

namespace facet {

struct json_document {
  std::string file;
  nlohmann::json root;
};

/// Reads a file of at most limits::scene_file bytes. Throws scene_error if it cannot be read, is
/// too large, is not JSON (the place is then a line and a column), nests more than 64 deep, or
/// repeats a key within an object.
json_document read_json_document(const std::filesystem::path& path);

/// A value of a document, and where it stands. Refers to the document, which must outlive it.
/// Every member throws scene_error where the value is not what was asked for.
class json_node {
 public:
  explicit json_node(const json_document& document);

  const std::string& place() const { return place_; }
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws "expected ALLOWED, found VALUE".
  [[noreturn]] void expected(const std::string& allowed) const;

  bool is_array() const { return value_->is_array(); }
  bool is_object() const { return value_->is_object(); }
  bool is_boolean() const { return value_->is_boolean(); }
  bool is_number() const { return value_->is_number(); }

  /// Checks that this is an object with none but these keys; `what` names it ("a camera").
  void check_keys(const std::string& what, const std::vector<std::string>& known) const;
  std::vector<std::string> keys() const;
  /// A member that must be there; `allowed` says what it would hold.
  json_node at(const std::string& key, const std::string& allowed) const;
  std::optional<json_node> find(const std::string& key) const;

  /// The number of elements of what must be an array; `allowed` describes it.
  std::size_t size(const std::string& allowed) const;
  json_node element(std::size_t index) const;

  bool boolean() const;
  double number() const;
  float single() const;
  std::uint32_t whole(std::uint32_t least, std::uint32_t most) const;
  std::string text(const std::string& allowed = "a text") const;
  /// An array of numbers, of one of the allowed lengths.
  std::vector<double> numbers(std::initializer_list<std::size_t> lengths,
                              const std::string& allowed) const;
  vec3d vector() const;
  /// 3 numbers, or one that stands for all three.
  vec3f colour() const;

 private:
  json_node(const json_document& document, const nlohmann::json& value, std::string place);
  float narrowed(double v) const;

  const json_document* document_;
  const nlohmann::json* value_;
  std::string place_;
};

}  // namespace facet
