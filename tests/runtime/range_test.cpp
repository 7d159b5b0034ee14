#include "runtime/range.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <type_traits>

using namespace facet::runtime;

TEST_CASE("a range's size is the product of its dimensions, in 64 bits") {
  CHECK(range<1>(7).size() == 7);
  CHECK(range<2>(3, 4).size() == 12);
  CHECK(range<3>(std::uint32_t(1) << 20, 1 << 10, 1 << 10).size() == std::uint64_t(1) << 40);
  CHECK(range<2>(0, 4).size() == 0);
}

TEST_CASE("dimensions follow from the number of sizes") {
  static_assert(std::is_same_v<decltype(range(1, 2u, std::size_t(3))), range<3>>);
  static_assert(std::is_same_v<decltype(id(1)), id<1>>);
  constexpr range r(5, 6);
  static_assert(std::is_same_v<decltype(range(r)), range<2>>);
  CHECK(r[0] == 5);
  CHECK(r.get(1) == 6);
}

TEST_CASE("an nd_range starts at 0 unless told otherwise") {
  constexpr nd_range<2> plain({8, 6}, {4, 2});
  CHECK(plain.get_offset() == id<2>(0, 0));
  CHECK(plain.get_local_range() == range<2>(4, 2));
  CHECK(nd_range<1>(range<1>(8), range<1>(4), id<1>(16)).get_offset()[0] == 16);
}
