// What a kernel's argument can be is decided as this file compiles.
#include "runtime/argument.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/runtime.hpp"

using namespace facet::runtime;

namespace {

struct float3_like {
  float x, y, z;
};
struct short3_like {
  short v[3];
};
struct float4_like {
  float x, y, z, w;
};
struct alignas(16) rows3 {
  float m[12];
};
struct base {
  int a;
};
struct spread : base {
  int b;
};
struct with_virtual {
  virtual ~with_virtual() = default;
  int a;
};
struct empty {};
enum class colour : std::uint32_t { red };
enum class wide : std::size_t { one };

}  // namespace

static_assert(can_be_argument<std::uint32_t> && can_be_argument<std::int32_t>);
static_assert(can_be_argument<std::uint8_t> && can_be_argument<std::int16_t>);
static_assert(can_be_argument<float> && can_be_argument<double> && can_be_argument<char>);
static_assert(can_be_argument<ulong_value> && can_be_argument<long_value>);
static_assert(can_be_argument<float4_like> && can_be_argument<std::array<float, 4>>);
static_assert(can_be_argument<rows3>, "three rows of 16 bytes are no 3-vector");
static_assert(can_be_argument<colour>);
static_assert(can_be_argument<accessor<int>> &&
              can_be_argument<accessor<float, access_mode::read>>);
static_assert(can_be_argument<local_accessor<int>>);
static_assert(can_be_argument<image_accessor<access_mode::read>> &&
              can_be_argument<image_accessor<access_mode::write>>);

static_assert(!can_be_argument<int*> && !can_be_argument<const void*>);
static_assert(!can_be_argument<std::nullptr_t> && !can_be_argument<int[2]>);
static_assert(!can_be_argument<char[4]> && !can_be_argument<void (*)()>);
static_assert(!can_be_argument<int float3_like::*>);
static_assert(!can_be_argument<bool> && !can_be_argument<long double>);
static_assert(!can_be_argument<std::size_t> && !can_be_argument<std::ptrdiff_t>);
static_assert(!can_be_argument<long> && !can_be_argument<unsigned long>);
static_assert(!can_be_argument<wchar_t> && !can_be_argument<char32_t>);
static_assert(!can_be_argument<wide>, "an enumeration is what it is stored as");
static_assert(!can_be_argument<float3_like> && !can_be_argument<short3_like>);
static_assert(!can_be_argument<std::array<float, 3>> &&
              !can_be_argument<std::array<std::size_t, 2>>);
static_assert(!can_be_argument<spread>, "members of two classes: no standard layout");
static_assert(!can_be_argument<with_virtual> && !can_be_argument<empty>);
static_assert(!can_be_argument<std::string> && !can_be_argument<std::vector<int>>);
static_assert(!can_be_argument<std::string_view> && !can_be_argument<std::span<int>>);
static_assert(!can_be_argument<range<2>> && !can_be_argument<id<1>> &&
              !can_be_argument<nd_range<1>>);
static_assert(!can_be_argument<buffer<int>> && !can_be_argument<image2d>);
static_assert(!can_be_argument<host_accessor<int>> && !can_be_argument<device>,
              "a handle holds a pointer");
static_assert(!can_be_argument<image_accessor<access_mode::read_write>>);

TEST_CASE("64-bit arguments have the size that OpenCL gives them") {
  CHECK(sizeof(ulong_value) == 8);
  CHECK(sizeof(long_value) == 8);
}
