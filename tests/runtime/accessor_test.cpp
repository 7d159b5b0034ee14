// The dependencies that accessors make, by wait lists, by order and by results.
#include "runtime/accessor.hpp"

#include <doctest/doctest.h>

#include <thread>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

namespace {

using ints = std::vector<int>;

/// Adds to the buffer, but not before the gate opens.
event add_behind(const test::gate& g, queue q, const buffer<int>& b, int value) {
  return q.submit([&](handler& h) {
    h.depends_on(g.event());
    h.set_args(accessor{b, h, read_write}, value);
    h.parallel_for(range(b.size()), test::kernel("add"));
  });
}

/// A buffer that is already on the device, so that no transfer stands between a test's commands.
buffer<int> on_device(int value) {
  buffer<int> b(64);
  test::set(test::queue(), b, value).wait_and_throw();
  return b;
}

}  // namespace

TEST_CASE("a read waits for the write, a write for the reads since, over any kind of queue") {
  for (bool out_of_order : {false, true}) {
    CAPTURE(out_of_order);
    queue q(test::device(), {.out_of_order = out_of_order});
    const buffer<int> x = on_device(1), y = on_device(0), z = on_device(0);
    test::gate gate;
    const event write = add_behind(gate, q, x, 4);
    const event read_y = test::copy(q, x, y), read_z = test::copy(q, x, z);
    const event overwrite = test::set(q, x, 100);
    const event again = test::add(q, x, 1);

    CHECK(write.get_wait_list().size() == 2);   // the gate, and the set of on_device
    CHECK(read_y.get_wait_list().size() == 2);  // the write of x, the set of y
    // Both reads; in an in-order queue the later stands for both.
    CHECK(overwrite.get_wait_list().size() == (q.is_in_order() ? 1 : 2));
    CHECK(again.get_wait_list().size() == 1);
    CHECK(again.get_wait_list()[0].get() == overwrite.get());
    for (const event& e : {write, read_y, read_z, overwrite, again})
      CHECK_FALSE(test::is_complete(e));

    gate.open();
    CHECK(test::contents(x) == ints(64, 101));
    CHECK(test::contents(y) == ints(64, 5));
    CHECK(test::contents(z) == ints(64, 5));
  }
}

TEST_CASE("reads do not wait for each other") {
  queue q(test::device(), {.out_of_order = true});
  const buffer<int> x = on_device(1), y = on_device(0), z = on_device(0);
  const event first = test::copy(q, x, y), second = test::copy(q, x, z);
  for (const event& e : second.get_wait_list()) CHECK(e.get() != first.get());
}

TEST_CASE("commands on different buffers have nothing to do with each other") {
  queue q(test::device(), {.out_of_order = true});
  const buffer<int> x = on_device(1);
  buffer<int> fresh(64);
  test::gate gate;
  add_behind(gate, q, x, 1);
  CHECK(test::set(q, fresh, 3).get_wait_list().empty());
  gate.open();
  CHECK(test::contents(fresh) == ints(64, 3));
}

TEST_CASE("dependencies go from queue to queue of one context") {
  for (bool out_of_order : {false, true}) {
    queue a(test::device(), {.out_of_order = out_of_order}), b(test::device());
    REQUIRE(a.get() != b.get());
    const buffer<int> x = on_device(1);
    test::gate gate;
    const event first = add_behind(gate, a, x, 1);  // 2
    const event second = b.submit([&](handler& h) {
      h.set_args(accessor{x, h, read_write}, 10);
      h.parallel_for(range(x.size()), test::kernel("add"));
    });
    const event third = test::add(a, x, 100);
    REQUIRE(second.get_wait_list().size() == 1);
    CHECK(second.get_wait_list()[0].get() == first.get());
    REQUIRE(third.get_wait_list().size() == 1);
    CHECK(third.get_wait_list()[0].get() == second.get());
    CHECK_FALSE(test::is_complete(second));
    gate.open();
    third.wait_and_throw();
    CHECK(test::contents(x) == ints(64, 112));
  }
}

TEST_CASE("a long chain over two out-of-order queues gives what one after the other gives") {
  queue a(test::device(), {.out_of_order = true}), b(test::device(), {.out_of_order = true});
  buffer<int> x(1000), y(1000);
  test::set(a, x, 0);
  for (int i = 0; i < 100; ++i) {
    test::add(i % 2 ? a : b, x, i);
    test::copy(i % 3 ? a : b, x, y);
    test::copy(i % 5 ? b : a, y, x);
  }
  CHECK(test::contents(x) == ints(1000, 4950));
}

TEST_CASE("two accessors of one buffer in a group add up to one requirement") {
  queue q(test::device(), {.out_of_order = true});
  const buffer<int> x = on_device(7), y = on_device(0);
  const event read = test::copy(q, x, y);
  const event both = q.submit([&](handler& h) {
    const accessor in{x, h, read_only};
    const accessor out{x, h, write_only};
    h.set_args(in, out);
    h.parallel_for(range(x.size()), test::kernel("copy"));
  });
  CHECK(both.get_wait_list().size() == 1);
  CHECK(both.get_wait_list()[0].get() == read.get());
  CHECK(test::contents(x) == ints(64, 7));
}

TEST_CASE("an accessor of another command group is refused") {
  const buffer<int> x = on_device(7);
  std::vector<accessor<int>> kept;
  test::queue().submit([&](handler& h) { kept.emplace_back(x, h); });
  CHECK_THROWS_WITH_AS(test::queue().submit([&](handler& h) { h.set_args(kept[0], 1); }),
                       doctest::Contains("another command group"), exception);
}

TEST_CASE("a group without an action ends when what it depends on has") {
  const buffer<int> x = on_device(7);
  for (bool out_of_order : {false, true}) {
    queue q(test::device(), {.out_of_order = out_of_order});
    test::gate gate;
    add_behind(gate, q, x, 1);
    const event all = q.submit([&](handler& h) { accessor{x, h, read_only}; });
    CHECK_FALSE(test::is_complete(all));
    gate.open();
    all.wait_and_throw();
    CHECK(test::is_complete(all));
    q.submit([](handler&) {}).wait_and_throw();
  }
}

TEST_CASE("threads may share a queue, a kernel and a buffer") {
  queue q(test::device(), {.out_of_order = true});
  buffer<int> shared(100);
  test::set(q, shared, 0);
  const kernel add = test::kernel("add");
  std::vector<std::thread> threads;
  std::vector<int> own_results(4);
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      buffer<int> own(10 + std::size_t(t));
      test::set(q, own, t);
      for (int i = 0; i < 50; ++i)
        for (const buffer<int>& b : {own, shared})
          q.submit([&](handler& h) {
            h.set_args(accessor{b, h, read_write}, t + 1);
            h.parallel_for(range(b.size()), add);
          });
      own_results[std::size_t(t)] = test::contents(own).back();
    });
  for (std::thread& t : threads) t.join();
  for (int t = 0; t < 4; ++t) CHECK(own_results[std::size_t(t)] == t + 50 * (t + 1));
  CHECK(test::contents(shared) == ints(100, 50 * (1 + 2 + 3 + 4)));
}

TEST_CASE("local memory of no elements is refused") {
  CHECK_THROWS_AS(test::queue().submit([&](handler& h) { local_accessor<int>(0, h); }), exception);
}
