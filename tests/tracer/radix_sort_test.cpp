#include "tracer/radix_sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"
#include "tracer/sort_ways_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

/// One for each way, kept: its scratch memory meets sorts of all sizes.
template <class Key>
radix_sort<Key>& sorter(const test::sort_way& way) {
  static std::map<std::string, radix_sort<Key>> all;
  const auto found = all.find(way.name);
  if (found != all.end()) return found->second;
  return all.emplace(way.name, radix_sort<Key>(test::queue(), kernel_sources(), way.tuned))
      .first->second;
}

/// Where std::stable_sort by the lowest `bits` bits takes each of the sorted keys from.
template <class Key>
std::vector<std::uint32_t> order_of(const std::vector<Key>& keys, unsigned bits) {
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  const Key mask = bits == 8 * sizeof(Key) ? ~Key(0) : Key((Key(1) << bits) - 1);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return (keys[a] & mask) < (keys[b] & mask); });
  return order;
}

/// How many keys or values of a sort are not where std::stable_sort has them. Values are sorted by
/// each way as they are, and as the keys' order.
template <class Key>
std::size_t misplaced(const test::sort_way& way, const std::vector<Key>& keys, unsigned bits,
                      const std::vector<std::uint32_t>& order) {
  const auto n = std::uint32_t(keys.size());
  std::vector<std::uint32_t> values(n);
  for (std::uint32_t i = 0; i < n; ++i) values[i] = i * 2654435761u;
  std::size_t wrong = 0;
  for (const bool is_order : {false, true}) {
    runtime::buffer<Key> k(keys.data(), n);
    runtime::buffer<std::uint32_t> v(values.data(), n);
    if (is_order)
      sorter<Key>(way).sort_order(k, v, n, bits);
    else
      sorter<Key>(way).sort(k, v, n, bits);
    const runtime::host_accessor sorted_keys{k, runtime::read_only};
    const runtime::host_accessor sorted_values{v, runtime::read_only};
    for (std::size_t i = 0; i < n; ++i)
      wrong += sorted_keys[i] != keys[order[i]] ||
               sorted_values[i] != (is_order ? order[i] : values[order[i]]);
  }
  return wrong;
}

template <class Key>
void check(const std::vector<Key>& keys, unsigned bits) {
  const std::vector<std::uint32_t> order = order_of(keys, bits);
  for (const test::sort_way& way : test::sort_ways()) {
    CAPTURE(way.name);
    CAPTURE(keys.size());
    CAPTURE(bits);
    CHECK(misplaced(way, keys, bits, order) == 0);
  }
}

template <class Key>
std::vector<Key> random_keys(std::size_t n, Key mask) {
  test::random r(n + sizeof(Key));
  std::vector<Key> keys(n);
  for (Key& k : keys) k = Key(r.bits()) & mask;
  return keys;
}

}  // namespace

TEST_CASE_TEMPLATE("values of equal keys keep their order, at every size around a tile", Key,
                   std::uint32_t, std::uint64_t) {
  constexpr unsigned bits = 8 * sizeof(Key);
  for (const test::sort_way& way : test::sort_ways()) {
    CAPTURE(way.name);
    const std::uint32_t tile = sizeof(Key) == 4 ? way.tile_32 : way.tile_64;
    for (const std::uint32_t n :
         {0u, 1u, 2u, 3u, 255u, 257u, tile - 1, tile, tile + 1, 2 * tile - 1, 2 * tile,
          3 * tile + 1, 12 * tile - 1, 12 * tile, 12 * tile + 1}) {
      CAPTURE(n);
      for (const Key mask : {~Key(0), Key(0x8001)}) {
        const std::vector<Key> keys = random_keys<Key>(n, mask);
        CHECK(misplaced(way, keys, bits, order_of(keys, bits)) == 0);
      }
    }
  }
}

TEST_CASE_TEMPLATE("sorted, reversed and equal keys", Key, std::uint32_t, std::uint64_t) {
  std::vector<Key> keys(20'000);
  std::iota(keys.begin(), keys.end(), Key(0));
  check(keys, 8 * sizeof(Key));
  std::reverse(keys.begin(), keys.end());
  check(keys, 8 * sizeof(Key));
  check(std::vector<Key>(20'000, Key(42)), 8 * sizeof(Key));
  check(std::vector<Key>(20'000, ~Key(0)), 8 * sizeof(Key));
  check(std::vector<Key>(20'000, Key(0)), 8 * sizeof(Key));
}

TEST_CASE_TEMPLATE("keys that do not spread evenly", Key, std::uint32_t, std::uint64_t) {
  constexpr unsigned bits = 8 * sizeof(Key), half = bits / 2;
  const std::size_t n = 20'000;
  test::random r(7);
  const auto keys_of = [&](auto key) {
    std::vector<Key> keys(n);
    for (std::size_t i = 0; i < n; ++i) keys[i] = key(Key(i), Key(r.bits()));
    return keys;
  };
  // Two; as far apart as can be, or neighbours across a carry.
  check(keys_of([](Key, Key x) { return x & 1 ? ~Key(0) : Key(0); }), bits);
  check(keys_of([](Key, Key x) { return Key((Key(1) << (bits - 1)) - (x & 1)); }), bits);
  // All within one bucket but for the least and the greatest.
  check(keys_of([](Key i, Key x) {
          return i == 77 ? ~Key(0) : i == 78 ? Key(0) : Key(1000 + x % 999);
        }),
        bits);
  // Upper bits in common, so that only the others, below a gap, tell keys apart.
  check(keys_of([](Key, Key x) { return Key((x >> half) % 40 << half | (x & 0xff)); }), bits);
  check(keys_of([](Key, Key x) { return Key((x >> half) % 3 << half | x >> half); }), bits);
  check(keys_of([](Key, Key x) { return Key(x << half); }), bits);
  check(keys_of([](Key, Key x) { return Key(x >> half); }), bits);
  // As many of each length; and so few in the greatest part that a sample may miss them.
  check(keys_of([](Key, Key x) { return Key(x >> x % bits); }), bits);
  check(keys_of([](Key i, Key x) { return i % 1999 == 1 ? x : Key(x & 0xffff); }), bits);
  check(keys_of([](Key i, Key x) { return i % 1999 == 1 ? x : Key(~(x & 0xffff)); }), bits);
  // In order, with steps; and a saw's teeth.
  check(keys_of([](Key i, Key) { return Key(i * 100'003); }), bits);
  check(keys_of([](Key i, Key) { return Key(~(i * 100'003)); }), bits);
  check(keys_of([](Key i, Key) { return Key(i % 256 << (bits - 8)); }), bits);
}

TEST_CASE_TEMPLATE("so few keys that insertion suffices, and a few more", Key, std::uint32_t,
                   std::uint64_t) {
  for (std::size_t n = 1; n < 70; ++n)
    for (const Key mask : {~Key(0), Key(7)}) check(random_keys<Key>(n, mask), 8 * sizeof(Key));
}

TEST_CASE_TEMPLATE("bits above those asked for do not count", Key, std::uint32_t, std::uint64_t) {
  for (const unsigned bits : {1u, 7u, 8u, 9u, 11u, 12u, 22u, 23u, 30u}) {
    check(random_keys<Key>(5'000, ~Key(0)), bits);
    check(std::vector<Key>(5'000, ~Key(0)), bits);
  }
  if (sizeof(Key) == 8)
    for (const unsigned bits : {33u, 57u, 63u}) {
      check(random_keys<Key>(5'000, ~Key(0)), bits);
      check(std::vector<Key>(5'000, ~Key(0)), bits);
      check(random_keys<Key>(5'000, ~(Key(0xfffff) << 20)), bits);
    }
}

TEST_CASE_TEMPLATE("a million keys by what the device is tuned to", Key, std::uint32_t,
                   std::uint64_t) {
  const std::vector<Key> keys = random_keys<Key>(1'000'003, ~Key(0));
  const std::vector<std::uint32_t> order = order_of(keys, 8 * sizeof(Key));
  CHECK(misplaced({"tuned", tuning_for(test::device()), 0, 0}, keys, 8 * sizeof(Key), order) == 0);
}

TEST_CASE("counts of so many tiles that a chunk of them is longer than the least") {
  // 256 chunks of 2,048 counts are those of 2,048 tiles of 1,024 keys.
  const std::vector<std::uint32_t> keys = random_keys<std::uint32_t>(2'200'000, ~0u);
  const std::vector<std::uint32_t> order = order_of(keys, 8);
  for (const test::sort_way& way : test::sort_ways())
    if (way.name == "counting") {
      REQUIRE(way.tile_32 * 2048 < keys.size());
      CHECK(misplaced(way, keys, 8, order) == 0);
    }
}

TEST_CASE("scratch memory is kept: a second sort of as many keys allocates nothing") {
  const std::vector<std::uint32_t> keys = random_keys<std::uint32_t>(10'000, ~0u);
  for (const test::sort_way& way : test::sort_ways()) {
    CAPTURE(way.name);
    radix_sort<std::uint32_t> s(test::queue(), kernel_sources(), way.tuned);
    runtime::buffer<std::uint32_t> k(keys.data(), keys.size()), v(keys.size());
    // 7 bits are one pass: keys and scratch change places, and must be the same two from then on.
    const auto sort_once = [&] {
      s.sort_order(k, v, std::uint32_t(keys.size()), 7);
      return k.get();
    };
    const auto first = sort_once(), second = sort_once();
    CHECK(sort_once() == first);
    CHECK(sort_once() == second);
    CHECK(radix_sort<std::uint32_t>::scratch_bytes(10'000, way.tuned.sort) >= 10'000 * 8);
  }
}

TEST_CASE("what cannot be sorted is refused") {
  radix_sort<std::uint32_t> s(test::queue(), kernel_sources(), tuning_for(test::device()));
  runtime::buffer<std::uint32_t> k(10), v(10);
  const auto refuses = [&](std::uint32_t count, unsigned bits, const char* why) {
    CHECK_THROWS_WITH_AS(s.sort(k, v, count, bits), why, runtime::exception);
  };
  refuses(10, 0, "a radix sort by 0 bits; 1 to 32 are allowed");
  refuses(10, 33, "a radix sort by 33 bits; 1 to 32 are allowed");
  refuses(11, 32, "a radix sort of 11 keys in buffers of 10 keys and 10 values");
  refuses(1u << 30, 32, "a radix sort of 1073741824 keys; at most 1073741823 are allowed");
}
