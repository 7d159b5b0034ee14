// Places inside a scene file, as JSON pointers (RFC 6901).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace facet {

/// The pointer to member `key` of what `parent` points to: '~' and '/' in the key are escaped.
inline std::string place_in(std::string_view parent, std::string_view key) {
  std::string place(parent);
  place += '/';
  for (char c : key) {
    if (c == '~')
      place += "~0";
    else if (c == '/')
      place += "~1";
    else
      place += c;
  }
  return place;
}

inline std::string place_in(std::string_view parent, std::size_t index) {
  return std::string(parent) + '/' + std::to_string(index);
}

}  // namespace facet
