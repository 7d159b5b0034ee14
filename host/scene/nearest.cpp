#include "scene/nearest.hpp"

#include <algorithm>
#include <cstdio>

namespace facet {
namespace {

/// Longer names are not compared: the table of distances stays small whatever a file holds.
constexpr std::size_t longest_name = 256;
constexpr std::size_t longest_list = 16;

char lower(char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; }

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  const std::size_t width = b.size() + 1;
  std::vector<std::size_t> rows(3 * width);  // those of i-2, i-1 and i, used in turn
  const auto cell = [&](std::size_t i, std::size_t j) -> std::size_t& {
    return rows[(i % 3) * width + j];
  };
  for (std::size_t i = 0; i <= a.size(); ++i) {
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        cell(i, j) = i + j;
        continue;
      }
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      std::size_t best = cell(i - 1, j - 1) + (same ? 0 : 1);
      best = std::min({best, cell(i - 1, j) + 1, cell(i, j - 1) + 1});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1]))
        best = std::min(best, cell(i - 2, j - 2) + 1);
      cell(i, j) = best;
    }
  }
  return cell(a.size(), b.size());
}

std::string nearest(std::string_view found, const std::vector<std::string>& known) {
  const std::string* best = nullptr;
  std::size_t best_distance = 0;
  if (found.size() > longest_name) return {};
  for (const std::string& name : known) {
    if (name.size() > longest_name) continue;
    const std::size_t distance = edit_distance(found, name);
    const std::size_t allowed = std::max<std::size_t>(1, std::max(found.size(), name.size()) / 3);
    if (distance <= allowed && (!best || distance < best_distance))
      best = &name, best_distance = distance;
  }
  return best ? *best : std::string();
}

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (char c : text.substr(0, 64)) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      char code[8];
      std::snprintf(code, sizeof code, "\\u%04x", unsigned(c));
      result += code;
    } else {
      result += c;
    }
  }
  return result + (text.size() > 64 ? "...\"" : "\"");
}

std::string unknown_name(std::string_view kind, std::string_view found,
                         const std::vector<std::string>& known) {
  std::string message = "there is no " + std::string(kind) + ' ' + in_quotes(found);
  const std::string suggestion = nearest(found, known);
  if (!suggestion.empty()) message += "; did you mean " + in_quotes(suggestion) + '?';
  if (known.empty()) return message + "; there is none at all";
  message += suggestion.empty() ? "; there are: " : " There are: ";
  for (std::size_t i = 0; i < std::min(known.size(), longest_list); ++i)
    message += (i ? ", " : "") + in_quotes(known[i]);
  if (known.size() > longest_list)
    message += " and " + std::to_string(known.size() - longest_list) + " more";
  return message;
}

}  // namespace facet
