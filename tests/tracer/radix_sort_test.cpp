#include "tracer/radix_sort.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

template <class Key>
radix_sort<Key>& sorter() {
  static radix_sort<Key> s(test::queue(), kernel_sources(), tuning_for(test::device()));
  return s;
}

/// Sorts on the device and holds the result against std::stable_sort by the lowest `bits` bits.
template <class Key>
void check(const std::vector<Key>& keys, unsigned bits) {
  const auto n = std::uint32_t(keys.size());
  std::vector<std::uint32_t> values(n);
  std::iota(values.begin(), values.end(), 0u);
  runtime::buffer<Key> k(keys.data(), n);
  runtime::buffer<std::uint32_t> v(values.data(), n);
  sorter<Key>().sort(k, v, n, bits);

  const Key mask = bits == 8 * sizeof(Key) ? ~Key(0) : Key((Key(1) << bits) - 1);
  std::stable_sort(values.begin(), values.end(),
                   [&](auto a, auto b) { return (keys[a] & mask) < (keys[b] & mask); });
  const runtime::host_accessor sorted_keys{k, runtime::read_only};
  const runtime::host_accessor sorted_values{v, runtime::read_only};
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < n; ++i)
    wrong += sorted_values[i] != values[i] || sorted_keys[i] != keys[values[i]];
  CHECK(wrong == 0);
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
  for (std::size_t n : {0u, 1u, 2u, 255u, 256u, 257u, 4095u, 4096u, 4097u, 100003u}) {
    CAPTURE(n);
    check(random_keys<Key>(n, ~Key(0)), 8 * sizeof(Key));
    check(random_keys<Key>(n, Key(15)), 8 * sizeof(Key));
  }
}

TEST_CASE_TEMPLATE("sorted, reversed and equal keys", Key, std::uint32_t, std::uint64_t) {
  std::vector<Key> keys(10000);
  std::iota(keys.begin(), keys.end(), Key(0));
  check(keys, 8 * sizeof(Key));
  std::reverse(keys.begin(), keys.end());
  check(keys, 8 * sizeof(Key));
  check(std::vector<Key>(10000, Key(42)), 8 * sizeof(Key));
  check(std::vector<Key>(10000, ~Key(0)), 8 * sizeof(Key));
}

TEST_CASE_TEMPLATE("bits above those asked for do not count", Key, std::uint32_t, std::uint64_t) {
  check(random_keys<Key>(5000, ~Key(0)), 8);
  check(random_keys<Key>(5000, ~Key(0)), 24);
}

TEST_CASE_TEMPLATE("ten million keys", Key, std::uint32_t, std::uint64_t) {
  check(random_keys<Key>(10'000'000, ~Key(0)), 8 * sizeof(Key));
}
