#include "scene/schema_helper.hpp"

#include <cmath>
#include <fstream>
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

std::string object_fault(const json& value, const json& schema, const std::string& place) {
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
    const std::string fault = schema_fault(member, *rule, place + '/' + key);
    if (!fault.empty()) return fault;
  }
  return "";
}

std::string array_fault(const json& value, const json& schema, const std::string& place) {
  if (!value.is_array()) return "";
  const std::size_t prefix = schema.contains("prefixItems") ? schema["prefixItems"].size() : 0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    if (i >= prefix && !schema.contains("items")) break;
    const json& rule = i < prefix ? schema["prefixItems"][i] : schema["items"];
    const std::string fault = schema_fault(value[i], rule, place + '/' + std::to_string(i));
    if (!fault.empty()) return fault;
  }
  return "";
}

/// allOf, anyOf, oneOf and not.
std::string logic_fault(const json& value, const std::string& keyword, const json& rules,
                        const std::string& place) {
  if (keyword == "not") return schema_fault(value, rules, place).empty() ? "is forbidden" : "";
  std::size_t kept = 0;
  std::string last;
  for (const json& rule : rules) {
    const std::string fault = schema_fault(value, rule, place);
    fault.empty() ? void(++kept) : void(last = fault);
  }
  if (keyword == "allOf") return last;
  const bool fits = keyword == "anyOf" ? kept > 0 : kept == 1;
  return fits ? "" : keyword + " keeps " + std::to_string(kept) + " (" + last + ")";
}

}  // namespace

const json& scene_schema() {
  static const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/scenes/facet-scene.schema.json"));
  return schema;
}

std::string schema_fault(const json& value, const json& schema, const std::string& place) {
  static const std::set<std::string> annotations{"$schema", "$defs", "title", "description",
                                                 "default"};
  static const std::set<std::string> numbers{"minimum", "maximum", "exclusiveMinimum",
                                             "exclusiveMaximum"};
  static const std::set<std::string> sizes{"minItems", "maxItems", "minProperties",
                                           "maxProperties"};
  static const std::set<std::string> logic{"allOf", "anyOf", "oneOf", "not"};
  std::string fault = object_fault(value, schema, place);
  if (fault.empty()) fault = array_fault(value, schema, place);
  if (!fault.empty()) return fault;
  for (const auto& [keyword, rule] : schema.items()) {
    if (keyword == "type")
      fault = type_fault(value, rule);
    else if (keyword == "const")
      fault = value == rule ? "" : "is not " + rule.dump();
    else if (numbers.count(keyword))
      fault = number_fault(value, keyword, rule.get<double>());
    else if (sizes.count(keyword))
      fault = size_fault(value, keyword, rule.get<std::size_t>());
    else if (logic.count(keyword))
      fault = logic_fault(value, keyword, rule, place);
    else if (keyword == "$ref")
      fault = schema_fault(
          value, scene_schema().at(json::json_pointer(rule.get<std::string>().substr(1))), place);
    else if (keyword == "required")
      for (const json& key : rule)
        if (value.is_object() && !value.contains(key.get<std::string>()))
          fault = "lacks " + key.dump();
    const bool known = annotations.count(keyword) || numbers.count(keyword) ||
                       sizes.count(keyword) || logic.count(keyword) || keyword == "type" ||
                       keyword == "const" || keyword == "$ref" || keyword == "required" ||
                       keyword == "properties" || keyword == "additionalProperties" ||
                       keyword == "items" || keyword == "prefixItems";
    if (!known) throw std::logic_error("unknown keyword " + keyword);
    if (!fault.empty()) return place + ": " + fault;
  }
  return "";
}

}  // namespace facet::test
