#include "tracer/bucket_sort.hpp"

#include <doctest/doctest.h>

#include <numeric>
#include <vector>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"
#include "tracer/random_helper.hpp"

using namespace facet;
using namespace facet::tracer;

namespace {

constexpr std::uint32_t tile = 3000;

/// Whether keys were sorted by buckets of at most `most`; if not they must be as they were.
template <class Key>
bool spreads(const std::vector<Key>& keys, std::uint32_t most, unsigned bits = 8 * sizeof(Key)) {
  tuning t = tuning_for(test::device());
  t.sort.bucket_mean = 250;
  t.sort.bucket_room = 500;
  t.sort.bucket_most = most;
  bucket_sort<Key> sorter(test::queue(), kernel_sources(), t);
  serial_scratch<Key> scratch;
  std::vector<step> steps;
  const auto n = std::uint32_t(keys.size());
  runtime::buffer<Key> k(keys.data(), n);
  runtime::buffer<std::uint32_t> v(n);
  sorter.sort({k, v, n, bits, true}, {tile, (n + tile - 1) / tile}, scratch, steps);
  const runtime::host_accessor plan{sorter.plan(), runtime::read_only};
  const runtime::host_accessor after{k, runtime::read_only};
  std::size_t moved = 0;
  for (std::size_t i = 0; i < n; ++i) moved += after[i] != keys[i];
  if (!plan[0].is_used) CHECK(moved == 0);
  CHECK(plan[0].buckets <= serial_scratch<Key>::digits);
  return plan[0].is_used;
}

template <class Key>
std::vector<Key> keys_of(std::size_t n, Key (*key)(Key i, Key random)) {
  test::random r(n);
  std::vector<Key> keys(n);
  for (std::size_t i = 0; i < n; ++i) keys[i] = key(Key(i), Key(r.bits()));
  return keys;
}

}  // namespace

TEST_CASE_TEMPLATE("keys are sorted by buckets where they spread over them", Key, std::uint32_t,
                   std::uint64_t) {
  if (test::device().is_gpu()) return;
  const auto random = keys_of<Key>(20'000, [](Key, Key x) { return x; });
  CHECK(spreads(random, 500));
  CHECK_FALSE(spreads(random, 0));
  CHECK(spreads(keys_of<Key>(20'000, [](Key i, Key) { return i; }), 500));
  CHECK(spreads(keys_of<Key>(20'000, [](Key, Key x) { return Key(x | ~(~Key(0) >> 12)); }), 500));
  // Bits that are not sorted by do not count.
  CHECK(
      spreads(keys_of<Key>(20'000, [](Key, Key x) { return Key(x << 31 | x % 30'000); }), 500, 30));
  // Nearly all in an eighth of the range: it takes more buckets than even spread would.
  CHECK(spreads(keys_of<Key>(20'000, [](Key i, Key x) { return i % 99 == 0 ? x : Key(x >> 3); }),
                500));

  CHECK_FALSE(spreads(std::vector<Key>(20'000, Key(3)), 5000));
  CHECK_FALSE(spreads(keys_of<Key>(20'000, [](Key, Key x) { return Key(x & 1); }), 5000));
  CHECK_FALSE(spreads(
      keys_of<Key>(20'000, [](Key i, Key x) { return i % 99 == 0 ? x : Key(x & 255); }), 500));
}

TEST_CASE("so few keys as a bucket may have are sorted however they are") {
  if (test::device().is_gpu()) return;
  CHECK(spreads(std::vector<std::uint32_t>(5000, 3u), 5000));
  CHECK(spreads(std::vector<std::uint64_t>(10'007, 3u), 10'007));
}
