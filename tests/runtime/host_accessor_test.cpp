#include "runtime/host_accessor.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <future>
#include <type_traits>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

using ints = std::vector<int>;

TEST_CASE("the host writes before the first command and between commands") {
  buffer<int> b(4);
  {
    const host_accessor w{b, write_only};
    for (std::size_t i = 0; i < w.size(); ++i) w[i] = int(i);
  }
  test::add(test::queue(), b, 10);
  {
    const host_accessor rw{b};
    CHECK(ints(rw.begin(), rw.end()) == ints{10, 11, 12, 13});
    rw[3] = 0;
  }
  test::add(test::queue(), b, 1);
  CHECK(test::contents(b) == ints{11, 12, 13, 1});
  {
    const host_accessor w{b, write_only, no_init};
    for (int& x : w) x = 5;
  }
  test::add(test::queue(), b, 1);
  CHECK(test::contents(b) == ints(4, 6));
}

TEST_CASE("writing some elements keeps the others") {
  buffer<int> b(1000);
  test::set(test::queue(), b, 3);
  {
    const host_accessor w{b, write_only};
    w[10] = 4;
  }
  ints expected(1000, 3);
  expected[10] = 4;
  test::add(test::queue(), b, 0);
  CHECK(test::contents(b) == expected);
}

TEST_CASE("commands wait until what the host wrote is back on the device") {
  buffer<int> b(1000);
  test::set(test::queue(), b, 3).wait_and_throw();
  { const host_accessor w{b, write_only}; }
  const std::vector<event> behind = test::add(test::queue(), b, 1).get_wait_list();
  REQUIRE(behind.size() == 1);
  cl_command_type type = 0;
  clGetEventInfo(behind[0].get(), CL_EVENT_COMMAND_TYPE, sizeof type, &type, nullptr);
  CHECK(type == CL_COMMAND_UNMAP_MEM_OBJECT);
}

TEST_CASE("a read-only one gives no way to write") {
  static_assert(std::is_same_v<host_accessor<int, access_mode::read>::value_type, const int>);
  static_assert(std::is_same_v<host_accessor<int, access_mode::write>::value_type, int>);
}

TEST_CASE("it waits for the commands on its own buffer and for no others, in the same queue too") {
  queue q(test::device());
  buffer<int> busy(64), idle(64);
  test::set(q, busy, 1);
  test::set(q, idle, 2);
  q.wait_and_throw();
  test::gate gate;
  q.submit([&](handler& h) {
    h.depends_on(gate.event());
    h.set_args(accessor{busy, h, read_write}, 1);
    h.parallel_for(range(busy.size()), test::kernel("add"));
  });
  auto of_idle = std::async(std::launch::async, [&] { return test::contents(idle); });
  // Far longer than a map of 256 bytes takes, far shorter than the gate stays shut without it.
  const auto soon = of_idle.wait_for(std::chrono::seconds(20));
  auto of_busy = std::async(std::launch::async, [&] { return test::contents(busy); });
  CHECK(of_busy.wait_for(std::chrono::milliseconds(20)) == std::future_status::timeout);
  gate.open();
  CHECK(soon == std::future_status::ready);
  CHECK(of_idle.get() == ints(64, 2));
  CHECK(of_busy.get() == ints(64, 2));
}

TEST_CASE("while one lives, what conflicts with it is refused, and nothing else") {
  for (bool used_before : {false, true}) {
    CAPTURE(used_before);
    buffer<int> b(ints(16, 1).data(), 16), other(16);
    if (used_before) test::add(test::queue(), b, 0).wait_and_throw();
    {
      const host_accessor reading{b, read_only};
      const host_accessor too{b, read_only};
      test::copy(test::queue(), b, other).wait_and_throw();
      CHECK(reading[5] == 1);
      CHECK(too[5] == 1);
      CHECK_THROWS_WITH_AS(test::add(test::queue(), b, 1), doctest::Contains("host_accessor"),
                           exception);
      CHECK_THROWS_AS((host_accessor{b, write_only}), exception);
    }
    {
      const host_accessor writing{b, read_write};
      CHECK_THROWS_AS(test::copy(test::queue(), b, other), exception);
      CHECK_THROWS_AS((host_accessor{b, read_only}), exception);
    }
    test::add(test::queue(), b, 1);
    CHECK(test::contents(b) == ints(16, 2));
    CHECK(test::contents(other) == ints(16, 1));
  }
}

TEST_CASE("what the host writes is written back") {
  ints data(4, 1);
  {
    const buffer b(data);
    test::queue().submit([&](handler& h) { h.fill(accessor{b, h, write_only}, 2); });
    const host_accessor w{b};
    w[0] = 9;
  }
  CHECK(data == ints{9, 2, 2, 2});
}

TEST_CASE("contents that a failed command should have written are not handed out") {
  queue q(test::device());
  buffer<int> b(16);
  test::set(q, b, 1).wait_and_throw();
  test::gate gate;
  q.submit([&](handler& h) {
    h.depends_on(gate.event());
    h.set_args(accessor{b, h, read_write}, 1);
    h.parallel_for(range(b.size()), test::kernel("add"));
  });
  gate.open(-5);
  CHECK_THROWS_AS(test::contents(b), exception);
}
