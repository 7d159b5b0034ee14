// The structures that cross between host and device: the common subset of C and C++.
//
// Only float, uint and arrays of them; every size is a multiple of 16 bytes, or of 8, and every group of four
// words starts at one, so that no compiler has room for an opinion. The sizes are asserted on
// both sides and each device is asked for its own (tests/tracer/layout_test.cpp).
#ifndef FACET_STRUCTURE_H
#define FACET_STRUCTURE_H

#ifdef __OPENCL_C_VERSION__
#define FACET_ALIGNED __attribute__((aligned(16)))
#define FACET_PAIR __attribute__((aligned(8)))
#define FACET_SIZE(type, bytes) typedef char size_of_##type[sizeof(type) == (bytes) ? 1 : -1];
#else
#include <cstdint>
namespace facet::tracer {
using uint = std::uint32_t;
}
#define FACET_ALIGNED alignas(16)
#define FACET_PAIR alignas(8)
#define FACET_SIZE(type, bytes) \
  static_assert(sizeof(type) == (bytes) && alignof(type) == ((bytes) % 16 == 0 ? 16 : 8));
#endif

#endif
