// cl/elementary.h as C++: the few names of OpenCL C that it needs, then its own text.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace facet::test::elementary {

using uint = std::uint32_t;

inline float as_float(uint bits) { return std::bit_cast<float>(bits); }
inline uint as_uint(float x) { return std::bit_cast<uint>(x); }
inline int as_int(float x) { return std::bit_cast<int>(x); }
inline float fma(float a, float b, float c) { return std::fma(a, b, c); }

#include "cl/elementary.h"

}  // namespace facet::test::elementary
