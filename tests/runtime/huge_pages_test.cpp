// Large buffers on a CPU: contents, alignment, and that their memory is used again.
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdint>
#include <fstream>
#include <numeric>
#include <vector>

#include "runtime/block_store.hpp"
#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;
using facet::runtime::detail::block_store;

namespace {

constexpr std::size_t page = block_store::page;

/// Bytes of memory that the process has in use.
std::uint64_t resident_bytes() {
  std::uint64_t size = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> size >> resident;
  return resident * std::uint64_t(sysconf(_SC_PAGESIZE));
}

}  // namespace

TEST_CASE("buffers about the size of huge pages keep their contents") {
  for (const std::size_t bytes : {page - 4, page, page + 4, 2 * page - 4, 2 * page + 4}) {
    std::vector<int> data(bytes / sizeof(int));
    std::iota(data.begin(), data.end(), 0);
    const buffer<int> b(data.data(), data.size());
    test::add(test::queue(), b, 7);
    for (int& x : data) x += 7;
    CHECK(test::contents(b) == data);
  }
}

TEST_CASE("a large buffer on a CPU begins at a huge page") {
#ifdef __linux__
  if (test::device().is_cpu()) {
    const buffer<int> b(page / sizeof(int) + 1);
    test::set(test::queue(), b, 1);
    const host_accessor here{b, read_only};
    CHECK(reinterpret_cast<std::uintptr_t>(&here[0]) % page == 0);
  }
#endif
}

TEST_CASE("the memory of large buffers is used again") {
  constexpr std::size_t each = 16 * page;
  const auto use_one = [] {
    const buffer<int> b(each / sizeof(int));
    test::set(test::queue(), b, 1).wait_and_throw();
  };
  use_one();
  const std::uint64_t before = resident_bytes();
  for (int k = 0; k < 20; ++k) use_one();
  // The driver may let go of one a moment after its last command has ended.
  CHECK(resident_bytes() < before + 2 * each);
}
