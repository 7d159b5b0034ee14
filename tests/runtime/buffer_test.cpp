#include "runtime/buffer.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <optional>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

using ints = std::vector<int>;

TEST_CASE("the last owner's death writes back, and no earlier one") {
  ints data(100, 1);
  {
    std::optional<buffer<int>> first(data);
    const buffer<int> second = *first;
    test::add(test::queue(), second, 5);
    first.reset();
    test::queue().wait_and_throw();
    CHECK(data == ints(100, 1));
  }
  CHECK(data == ints(100, 6));
}

TEST_CASE("write-back waits for the writer") {
  ints data(100, 1);
  test::gate gate;
  std::optional<buffer<int>> b(data);
  test::add(test::queue(), *b, 1).wait_and_throw();
  test::queue().submit([&](handler& h) {
    h.depends_on(gate.event());
    h.set_args(accessor{*b, h, read_write}, 40);
    h.parallel_for(range(b->size()), test::kernel("add"));
  });
  gate.open();
  b.reset();
  CHECK(data == ints(100, 42));
}

TEST_CASE("data given by pointer is copied at once and never written back") {
  ints data(100, 1);
  {
    const buffer<int> b(data.data(), data.size());
    data.assign(100, 9);
    test::add(test::queue(), b, 5);
    CHECK(test::contents(b) == ints(100, 6));
  }
  CHECK(data == ints(100, 9));
}

TEST_CASE("final data says where to write back, and nowhere") {
  ints data(10, 1), other(10, 0);
  {
    buffer b(data);
    b.set_final_data(other.data());
    test::add(test::queue(), b, 1);
  }
  CHECK(data == ints(10, 1));
  CHECK(other == ints(10, 2));
  {
    buffer b(data);
    b.set_final_data(nullptr);
    b.set_write_back(true);
    test::add(test::queue(), b, 1);
  }
  {
    buffer b(data);
    b.set_write_back(false);
    test::add(test::queue(), b, 1);
  }
  CHECK(data == ints(10, 1));
  {
    buffer<int> b(data.data(), data.size());  // never on a device
    b.set_final_data(other.data());
  }
  CHECK(other == ints(10, 1));
}

TEST_CASE("a bound span is written back where it lies") {
  ints data(10, 1);
  {
    const buffer b(std::span<int>(data).subspan(2, 3));
    CHECK(b.size() == 3);
    test::set(test::queue(), b, 7);
  }
  CHECK(data == ints{1, 1, 7, 7, 7, 1, 1, 1, 1, 1});
}

TEST_CASE("a buffer of 0 elements can be made, given to a kernel, read, copied and filled") {
  buffer<int> none(0);
  ints nothing;
  {
    const buffer bound(nothing);
    const buffer<int> copied(nullptr, 0);
    CHECK(copied.byte_size() == 0);
    const kernel k = test::kernel("set");
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{none, h, write_only}, 1);
      h.parallel_for(range(0), k);
    });
    // A kernel that leaves it alone runs: its argument is a valid buffer.
    const program p = test::program_of("__kernel void leave(__global int* x) {}");
    for (const buffer<int>& b : {none, bound, copied})
      test::queue().submit([&](handler& h) {
        h.set_args(accessor{b, h, read_write});
        h.single_task(p.get_kernel("leave"));
      });
    test::queue().submit([&](handler& h) { h.fill(accessor{none, h, write_only}, 3); });
    test::queue().submit([&](handler& h) {
      h.copy(accessor{copied, h, read_only}, accessor{none, h, write_only});
    });
    test::queue().submit([&](handler& h) {
      h.copy(accessor{none, h, read_only}, static_cast<int*>(nullptr));
    });
  }
  test::queue().wait_and_throw();
  const host_accessor read{none, read_only};
  CHECK(read.empty());
}

TEST_CASE("a buffer larger than the device allows is refused with both figures") {
  const std::uint64_t most = test::device().max_mem_alloc_size();
  const buffer<char> large(most + 1);
  const program p = test::program_of("__kernel void leave(__global char* x) {}");
  try {
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{large, h, read_write});
      h.single_task(p.get_kernel("leave"));
    });
    FAIL("not refused");
  } catch (const exception& e) {
    CHECK(e.code() == errc::memory_allocation);
    CHECK(std::string(e.what()).find(std::to_string(most + 1)) != std::string::npos);
    CHECK(std::string(e.what()).find(std::to_string(most)) != std::string::npos);
  }
  CHECK_THROWS_AS(buffer<int>(~std::size_t(0) / 2), exception);
}

TEST_CASE("a buffer stays in the context of its first use") {
  buffer<int> b(10);
  test::set(test::queue(), b, 1);
  queue other(context(test::device()), test::device());
  CHECK_THROWS_WITH_AS(other.submit([&](handler& h) {
    h.fill(accessor{b, h, write_only}, 1);
  }),
                       doctest::Contains("context"), exception);
  CHECK(test::contents(b) == ints(10, 1));
}

TEST_CASE("after a failed command nothing is written back, no destructor throws, the queue knows") {
  ints data(10, 1);
  queue q(test::device());
  {
    const buffer b(data);
    test::add(q, b, 1).wait_and_throw();
    test::gate gate;
    q.submit([&](handler& h) {
      h.depends_on(gate.event());
      h.set_args(accessor{b, h, read_write}, 1);
      h.parallel_for(range(b.size()), test::kernel("add"));
    });
    gate.open(-5);
  }
  CHECK(data == ints(10, 1));
  CHECK_THROWS_AS(q.wait_and_throw(), exception);
}

TEST_CASE("a context counts the memory on its devices, and the most that it was") {
  context c(test::device());
  queue q(c, test::device());
  const auto use = [&](buffer<int>& b) {
    q.submit([&](handler& h) { h.fill(accessor{b, h, write_only}, 1); });
  };
  const std::uint64_t before = c.memory_in_use();
  buffer<int> kept(1000);
  CHECK(c.memory_in_use() == before);  // no command has used it
  use(kept);
  CHECK(c.memory_in_use() == before + 4000);
  {
    buffer<int> passing(500);
    use(passing);
    CHECK(c.memory_in_use() == before + 6000);
  }
  CHECK(c.memory_in_use() == before + 4000);
  CHECK(c.peak_memory() >= before + 6000);
  c.restart_peak();
  CHECK(c.peak_memory() == before + 4000);
}
