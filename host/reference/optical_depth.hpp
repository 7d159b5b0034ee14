// -ln of what a straight way lets pass, per channel: a sum that does not depend on its order.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "scene/vec.hpp"

namespace facet::reference {

/// Fixed point in units of 2^-32, 64 bits, modulo 2^64: integers add in any order to the same sum.
template <class T>
class optical_depth {
 public:
  void add(const vec3<T>& term) {
    for (int i = 0; i < 3; ++i) sum_[std::size_t(i)] += std::uint64_t(fixed(term[i]));
  }

  /// exp(-sum), at most 1.
  vec3<T> passing() const { return {passing(sum_[0]), passing(sum_[1]), passing(sum_[2])}; }

 private:
  static std::int64_t fixed(T x) {
    constexpr T most = T(0x1p30);
    return std::llrint(std::clamp(x, -most, most) * T(0x1p32));
  }
  static T passing(std::uint64_t sum) {
    const auto depth = std::max<std::int64_t>(std::int64_t(sum), 0);
    return std::exp(-T(depth) * T(0x1p-32));
  }

  std::array<std::uint64_t, 3> sum_{};
};

}  // namespace facet::reference
