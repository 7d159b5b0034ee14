#include "study/json_text.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace facet::study {
namespace {

using json = nlohmann::ordered_json;

constexpr std::size_t line_width = 100;

std::string scalar(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

bool is_plain_list(const json& value) {
  return value.is_array() && std::none_of(value.begin(), value.end(),
                                          [](const json& item) { return item.is_structured(); });
}

void write(const json& value, std::size_t depth, std::string& out);

void write_plain_list(const json& list, std::size_t depth, std::string& out) {
  std::size_t line_start = out.rfind('\n') + 1;  // npos + 1 is 0
  out += '[';
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string text = scalar(list[i]) + (i + 1 < list.size() ? "," : "");
    if (i > 0 && out.size() - line_start + 1 + text.size() > line_width) {
      out += '\n';
      line_start = out.size();
      out.append(2 * depth + 2, ' ');
    } else if (i > 0) {
      out += ' ';
    }
    out += text;
  }
  out += ']';
}

void write_members(const json& value, std::size_t depth, std::string& out) {
  bool first = true;
  for (const auto& [key, member] : value.items()) {
    out += first ? "\n" : ",\n";
    first = false;
    out.append(2 * depth + 2, ' ');
    if (value.is_object()) out += scalar(key) + ": ";
    write(member, depth + 1, out);
  }
  out += '\n';
  out.append(2 * depth, ' ');
}

void write(const json& value, std::size_t depth, std::string& out) {
  if (!value.is_structured()) {
    out += scalar(value);
  } else if (is_plain_list(value)) {
    write_plain_list(value, depth, out);
  } else {
    out += value.is_object() ? '{' : '[';
    if (!value.empty()) write_members(value, depth, out);
    out += value.is_object() ? '}' : ']';
  }
}

}  // namespace

std::string json_text(const json& value) {
  std::string out;
  write(value, 0, out);
  return out + '\n';
}

}  // namespace facet::study
