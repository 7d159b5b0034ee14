// Sizes of tests under the sanitizers.
#pragma once

#include <cstdint>

namespace facet::test {

/// n; a fifth of it under the sanitizers: they slow a loop down, and what they look for shows
/// early.
constexpr std::uint32_t fewer(std::uint32_t n) {
#if defined(__SANITIZE_ADDRESS__)
  return n / 5;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  return n / 5;
#endif
#endif
  return n;
}

}  // namespace facet::test
