#include "runtime/event.hpp"

#include <doctest/doctest.h>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

TEST_CASE("a command's times follow each other") {
  buffer<int> b(100000);
  const event e = test::set(test::queue(), b, 1);
  const auto submit = e.get_profiling_info<info::event_profiling::command_submit>();
  const auto start = e.get_profiling_info<info::event_profiling::command_start>();
  const auto end = e.get_profiling_info<info::event_profiling::command_end>();
  CHECK(submit <= start);
  CHECK(start <= end);
  CHECK(e.milliseconds() == double(end - start) * 1e-6);
  CHECK(test::is_complete(e));
}

TEST_CASE("a queue without profiling gives no times") {
  queue q(test::device(), {.profiling = false});
  buffer<int> b(10);
  const event e = test::set(q, b, 1);
  try {
    e.milliseconds();
    FAIL("not refused");
  } catch (const exception& x) {
    CHECK(x.code() == errc::profiling);
  }
  CHECK(test::contents(b)[9] == 1);
}

TEST_CASE("an event of no command is complete") {
  const event none;
  none.wait();
  none.wait_and_throw();
  CHECK(test::is_complete(none));
  CHECK(none.get_wait_list().empty());
  CHECK_THROWS_AS(none.milliseconds(), exception);
}

TEST_CASE("an event that the caller made holds back what depends on it") {
  buffer<int> b(10);
  test::set(test::queue(), b, 1).wait_and_throw();
  test::gate gate;
  CHECK_FALSE(test::is_complete(gate.event()));
  const event e = test::queue().submit([&](handler& h) {
    h.depends_on(std::vector<event>{gate.event(), event()});
    h.fill(accessor{b, h, write_only}, 2);
  });
  CHECK_FALSE(test::is_complete(e));
  gate.open();
  event::wait({e, gate.event()});
  CHECK(test::is_complete(e));
}
