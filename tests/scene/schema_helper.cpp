#include "scene/schema_helper.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <regex>
#include <set>
#include <stdexcept>
#include <vector>

namespace facet::test {
namespace {

using nlohmann::json;

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer")
    return value.is_number() && value.get<double>() == std::floor(value.get<double>());
  throw std::logic_error("unknown type " + type);
}

std::string type_fault(const json& value, const json& types) {
  const std::vector<json> any =
      types.is_array() ? types.get<std::vector<json>>() : std::vector{types};
  for (const json& type : any)
    if (has_type(value, type.get<std::string>())) return "";
  return "is not " + types.dump();
}

std::string number_fault(const json& value, const std::string& keyword, double bound) {
  if (!value.is_number()) return "";
  const double v = value.get<double>();
  const bool fits = keyword == "minimum"            ? v >= bound
                    : keyword == "maximum"          ? v <= bound
                    : keyword == "exclusiveMinimum" ? v > bound
                                                    : v < bound;
  return fits ? "" : keyword + " is " + std::to_string(bound);
}

std::string size_fault(const json& value, const std::string& keyword, std::size_t bound) {
  const bool items = keyword == "minItems" || keyword == "maxItems";
  if (items ? !value.is_array() : !value.is_object()) return "";
  const bool fits = keyword.substr(0, 3) == "min" ? value.size() >= bound : value.size() <= bound;
  return fits ? "" : keyword + " is " + std::to_string(bound);
}

/// Rules of one schema, whose references start at its root.
class checker {
 public:
  explicit checker(const json& root) : root_(root) {}

  std::string fault(const json& value, const json& schema, const std::string& place) const;

 private:
  std::string object_fault(const json& value, const json& schema, const std::string& place) const;
  std::string array_fault(const json& value, const json& schema, const std::string& place) const;
  std::string logic_fault(const json& value, const std::string& keyword, const json& rules,
                          const std::string& place) const;

  const json& root_;
};

std::string checker::object_fault(const json& value, const json& schema,
                                  const std::string& place) const {
  if (!value.is_object()) return "";
  const json none = json::object();
  const json& properties = schema.contains("properties") ? schema["properties"] : none;
  for (const auto& [key, member] : value.items()) {
    const json* rule = properties.contains(key)                  ? &properties[key]
                       : schema.contains("additionalProperties") ? &schema["additionalProperties"]
                                                                 : nullptr;
    if (!rule) continue;
    if (rule->is_boolean()) {
      if (!rule->get<bool>()) return place + ": the key " + key + " is not allowed";
      continue;
    }
    const std::string found = fault(member, *rule, place + '/' + key);
    if (!found.empty()) return found;
  }
  return "";
}

std::string checker::array_fault(const json& value, const json& schema,
                                 const std::string& place) const {
  if (!value.is_array()) return "";
  const std::size_t prefix = schema.contains("prefixItems") ? schema["prefixItems"].size() : 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (i >= prefix && !schema.contains("items")) break;
    const json& rule = i < prefix ? schema["prefixItems"][i] : schema["items"];
    const std::string found = fault(value[i], rule, place + '/' + std::to_string(i));
    if (!found.empty()) return found;
  }
  return "";
}

/// allOf, anyOf, oneOf and not.
std::string checker::logic_fault(const json& value, const std::string& keyword, const json& rules,
                                 const std::string& place) const {
  if (keyword == "not") return fault(value, rules, place).empty() ? "is forbidden" : "";
  std::size_t kept = 0;
  std::string last;
  for (const json& rule : rules) {
    const std::string found = fault(value, rule, place);
    found.empty() ? void(++kept) : void(last = found);
  }
  if (keyword == "allOf") return last;
  const bool fits = keyword == "anyOf" ? kept > 0 : kept == 1;
  return fits ? "" : keyword + " keeps " + std::to_string(kept) + " (" + last + ")";
}

std::string checker::fault(const json& value, const json& schema, const std::string& place) const {
  static const std::set<std::string> annotations{"$schema", "$defs", "title", "description",
                                                 "default"};
  static const std::set<std::string> numbers{"minimum", "maximum", "exclusiveMinimum",
                                             "exclusiveMaximum"};
  static const std::set<std::string> sizes{"minItems", "maxItems", "minProperties",
                                           "maxProperties"};
  static const std::set<std::string> logic{"allOf", "anyOf", "oneOf", "not"};
  std::string found = object_fault(value, schema, place);
  if (found.empty()) found = array_fault(value, schema, place);
  if (!found.empty()) return found;
  for (const auto& [keyword, rule] : schema.items()) {
    if (keyword == "type")
      found = type_fault(value, rule);
    else if (keyword == "const")
      found = value == rule ? "" : "is not " + rule.dump();
    else if (keyword == "enum")
      found = std::find(rule.begin(), rule.end(), value) != rule.end()
                  ? ""
                  : "is none of " + rule.dump();
    else if (keyword == "pattern")
      found = !value.is_string() || std::regex_search(value.get<std::string>(),
                                                      std::regex(rule.get<std::string>()))
                  ? ""
                  : "does not match " + rule.dump();
    else if (numbers.count(keyword))
      found = number_fault(value, keyword, rule.get<double>());
    else if (sizes.count(keyword))
      found = size_fault(value, keyword, rule.get<std::size_t>());
    else if (logic.count(keyword))
      found = logic_fault(value, keyword, rule, place);
    else if (keyword == "$ref")
      found = fault(value, root_.at(json::json_pointer(rule.get<std::string>().substr(1))), place);
    else if (keyword == "required")
      for (const json& key : rule)
        if (value.is_object() && !value.contains(key.get<std::string>()))
          found = "lacks " + key.dump();
    const bool known = annotations.count(keyword) || numbers.count(keyword) ||
                       sizes.count(keyword) || logic.count(keyword) || keyword == "type" ||
                       keyword == "const" || keyword == "enum" || keyword == "pattern" ||
                       keyword == "$ref" || keyword == "required" || keyword == "properties" ||
                       keyword == "additionalProperties" || keyword == "items" ||
                       keyword == "prefixItems";
    if (!known) throw std::logic_error("unknown keyword " + keyword);
    if (!found.empty()) return place + ": " + found;
  }
  return "";
}

}  // namespace

const json& scene_schema() {
  static const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/scenes/facet-scene.schema.json"));
  return schema;
}

std::string schema_fault(const json& value, const json& schema) {
  return checker(schema).fault(value, schema, "");
}

}  // namespace facet::test
