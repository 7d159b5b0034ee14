#include "runtime/queue.hpp"

#include <doctest/doctest.h>

#include <string>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

namespace {

/// A command that fails once it was submitted: what it waits for does.
void submit_failing(queue& q, const buffer<int>& b) {
  test::gate gate;
  q.submit([&](handler& h) {
    h.depends_on(gate.event());
    h.set_args(accessor{b, h, read_write}, 1);
    h.parallel_for(range(b.size()), test::kernel("add"));
  });
  gate.open(-5);
}

buffer<int> on_device() {
  buffer<int> b(16);
  test::set(test::queue(), b, 1).wait_and_throw();
  return b;
}

}  // namespace

TEST_CASE("queues of one device share its context while one lives") {
  const queue a(test::device()), b(test::device());
  CHECK(a.get_context() == b.get_context());
  CHECK(a.get_device() == test::device());
  CHECK(context(test::device()) != a.get_context());
}

TEST_CASE("a queue says whether it is in order") {
  CHECK(queue(test::device()).is_in_order());
  CHECK(queue(test::device(), {.out_of_order = true}).is_in_order() ==
        !test::device().has_out_of_order_queues());
  CHECK(queue(test::device()).has_profiling());
}

TEST_CASE("copies of a queue are the same queue") {
  const queue a(test::device());
  const queue b = a;
  CHECK(a == b);
  CHECK(a.get() == b.get());
  CHECK_FALSE(a == queue(test::device()));
}

TEST_CASE("without a handler a command's failure is thrown once, with the kernel's name") {
  queue q(test::device());
  submit_failing(q, on_device());
  q.wait();
  try {
    q.wait_and_throw();
    FAIL("nothing was thrown");
  } catch (const exception& e) {
    CHECK(std::string(e.what()).find("kernel 'add'") != std::string::npos);
    CHECK(e.cl_code() < 0);
  }
  q.wait_and_throw();
}

TEST_CASE("a handler receives the failures, and nothing is thrown") {
  exception_list found;
  queue q(test::device(), {}, [&](exception_list list) { found = std::move(list); });
  q.wait_and_throw();
  CHECK(found.empty());
  submit_failing(q, on_device());
  q.wait_and_throw();
  REQUIRE(found.size() == 1);
  CHECK_THROWS_AS(std::rethrow_exception(found[0]), exception);
}

TEST_CASE("what depends on a failed command does not run") {
  for (bool out_of_order : {false, true}) {
    queue q(test::device(), {.out_of_order = out_of_order}), other(test::device());
    const buffer<int> b = on_device(), to = on_device();
    submit_failing(q, b);
    q.wait();
    // Known to have failed: refused at once in a queue that waits for it by a list.
    CHECK_THROWS_WITH_AS(test::copy(other, b, to), doctest::Contains("depends on failed"),
                         exception);
    CHECK(test::contents(to) == std::vector<int>(16, 1));
    CHECK_THROWS_AS(q.wait_and_throw(), exception);
  }
}

TEST_CASE("many commands that nobody waits for are no burden") {
  queue q(test::device());
  buffer<int> b(4);
  test::set(q, b, 0);
  for (int i = 0; i < 2000; ++i) test::add(q, b, 1);
  CHECK(test::contents(b) == std::vector<int>(4, 2000));
}
