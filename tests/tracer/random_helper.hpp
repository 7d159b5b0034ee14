// Numbers that are the same on every machine: a hash of a counter.
#pragma once

#include <cstdint>

#include "scene/vec.hpp"

namespace facet::test {

class random {
 public:
  explicit random(std::uint64_t seed) : state_(seed * 0x9e3779b97f4a7c15ull + 1) {}

  std::uint64_t bits() {  // splitmix64 (Steele, Lea and Flood, 2014)
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  /// 0 up to, but not, 1.
  float uniform() { return float(bits() >> 40) * 0x1p-24f; }
  float between(float lo, float hi) { return lo + (hi - lo) * uniform(); }
  vec3f in_cube() { return {between(-1, 1), between(-1, 1), between(-1, 1)}; }
  std::uint32_t below(std::uint32_t n) { return std::uint32_t(bits() % n); }

 private:
  std::uint64_t state_;
};

}  // namespace facet::test
