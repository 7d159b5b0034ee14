// Sizes of tests under the sanitizers.
#pragma once

#include <cstdint>

namespace facet::test {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool is_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool is_sanitized = __has_feature(address_sanitizer);
#else
inline constexpr bool is_sanitized = false;
#endif

/// n; a fifth of it under the sanitizers: they slow a loop down, and what they look for shows
/// early.
constexpr std::uint32_t fewer(std::uint32_t n) { return is_sanitized ? n / 5 : n; }

}  // namespace facet::test
