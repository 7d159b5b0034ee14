#include "runtime/block_store.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <cstring>
#include <vector>

using facet::runtime::detail::block_store;

#ifdef __linux__

namespace {

constexpr std::size_t page = block_store::page;

}  // namespace

TEST_CASE("a block has whole huge pages and begins at one") {
  block_store store(0);
  for (const std::size_t bytes : {std::size_t(1), page - 1, page, page + 1, 5 * page}) {
    const block_store::block b = store.take(bytes);
    REQUIRE(b.memory);
    CHECK(reinterpret_cast<std::uintptr_t>(b.memory) % page == 0);
    CHECK(b.bytes == (bytes + page - 1) / page * page);
    std::memset(b.memory, 1, b.bytes);
    store.give_back(b);
  }
}

TEST_CASE("a block that was given back is taken again, but not for much less") {
  block_store store(100 * page);
  const block_store::block large = store.take(8 * page);
  store.give_back(large);
  CHECK(store.kept_bytes() == 8 * page);
  const block_store::block small = store.take(6 * page);
  CHECK(small.memory != large.memory);
  const block_store::block again = store.take(7 * page);
  CHECK(again.memory == large.memory);
  CHECK(again.bytes == 8 * page);
  CHECK(store.kept_bytes() == 0);
  store.give_back(small);
  store.give_back(again);
}

TEST_CASE("of several kept blocks the smallest that is enough is taken") {
  block_store store(100 * page);
  const block_store::block ten = store.take(10 * page), nine = store.take(9 * page);
  store.give_back(ten);
  store.give_back(nine);
  const block_store::block b = store.take(8 * page + 1);
  CHECK(b.memory == nine.memory);
  store.give_back(b);
}

TEST_CASE("no more is kept than is allowed") {
  block_store store(5 * page);
  std::vector<block_store::block> all;
  for (int k = 0; k < 4; ++k) all.push_back(store.take(2 * page));
  for (const block_store::block& b : all) store.give_back(b);
  CHECK(store.kept_bytes() == 4 * page);
}

#endif
