#include "runtime/handler.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

using ints = std::vector<int>;

namespace {

/// Submits and returns the message of what is thrown; "" if nothing is.
template <class Group>
std::string refused(errc code, Group&& group) {
  try {
    test::queue().submit(group);
  } catch (const exception& e) {
    CHECK(e.code() == code);
    return e.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("every kind of value reaches the kernel bit by bit") {
  struct pair {
    float a;
    std::int32_t b;
  };
  const program p = test::program_of(R"(
typedef struct { float a; int b; } pair;
__kernel void gather(__global ulong* out, uchar c, short s, uint u, ulong l, float4 v, pair q) {
  out[0] = c;  out[1] = (ulong)(long)s;  out[2] = u;  out[3] = l;
  out[4] = as_uint(v.w);  out[5] = as_uint(q.a);  out[6] = (ulong)(long)q.b;
}
)");
  buffer<std::uint64_t> out(7);
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{out, h, write_only}, std::uint8_t(200), std::int16_t(-3), 4000000000u,
               ulong_value{0x123456789abcdef0u}, std::array<float, 4>{0, 0, 0, 1.5f},
               pair{-2.5f, -7});
    h.single_task(p.get_kernel("gather"));
  });
  const host_accessor found{out, read_only};
  CHECK(found[0] == 200);
  CHECK(found[1] == std::uint64_t(-3));
  CHECK(found[2] == 4000000000u);
  CHECK(found[3] == 0x123456789abcdef0u);
  CHECK(found[4] == 0x3fc00000u);  // 1.5f
  CHECK(found[5] == 0xc0200000u);  // -2.5f
  CHECK(found[6] == std::uint64_t(-7));
}

TEST_CASE("arguments may be set one by one in any order, and again") {
  buffer<int> b(8);
  test::queue().submit([&](handler& h) {
    h.set_arg(1, 5);
    h.set_arg(0, accessor{b, h, write_only});
    h.set_arg(1, 6);
    h.parallel_for(range(8), test::kernel("set"));
  });
  CHECK(test::contents(b) == ints(8, 6));
}

TEST_CASE("too many, too few and missing arguments are refused with the count") {
  const buffer<int> b(8);
  const kernel k = test::kernel("set");
  const auto too_many = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, write_only}, 1, 2);
    h.parallel_for(range(8), k);
  });
  CHECK(has(too_many, "'set': 3 arguments were set, and it takes 2"));
  const auto too_few = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, write_only});
    h.parallel_for(range(8), k);
  });
  CHECK(has(too_few, "argument 1"));
  CHECK(has(too_few, "2 of them"));
  const auto hole = refused(errc::kernel_argument, [&](handler& h) {
    h.set_arg(1, 3);
    h.parallel_for(range(8), k);
  });
  CHECK(has(hole, "argument 0"));
}

TEST_CASE("an argument that does not fit the kernel's is refused, and both are named") {
  const buffer<int> b(8);
  const kernel k = test::kernel("copy");
  if (!has(refused(errc::kernel_argument,
                   [&](handler& h) {
                     h.set_args(1, 2);
                     h.parallel_for(range(8), k);
                   }),
           "from"))
    return;  // a driver without argument info: nothing to check against
  const auto value = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, read_only}, 2);
    h.parallel_for(range(8), k);
  });
  CHECK(has(value, "__global int* to"));
  CHECK(has(value, "a value"));
  const auto local = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, read_only}, local_accessor<int>(8, h));
    h.parallel_for(range(8), k);
  });
  CHECK(has(local, "a local_accessor"));
  const auto unwritable = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, read_only}, accessor{b, h, read_only});
    h.parallel_for(range(8), k);
  });
  CHECK(has(unwritable, "argument 1"));
  CHECK(has(unwritable, "read_only accessor"));
  const auto unreadable = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, write_only}, accessor{b, h, write_only});
    h.parallel_for(range(8), k);
  });
  CHECK(has(unreadable, "const int* from"));
  const auto size = refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, write_only}, std::uint8_t(1));
    h.parallel_for(range(8), test::kernel("set"));
  });
  CHECK(has(size, "argument 1"));
  CHECK(has(size, "1 bytes"));
}

TEST_CASE("a failed submission leaves buffers as they were") {
  buffer<int> b(8);
  test::set(test::queue(), b, 3);
  refused(errc::kernel_argument, [&](handler& h) {
    h.set_args(accessor{b, h, read_write});
    h.parallel_for(range(8), test::kernel("add"));
  });
  CHECK(test::contents(b) == ints(8, 3));
}

TEST_CASE("a group has one action") {
  const buffer<int> b(8);
  CHECK(has(refused(errc::invalid,
                    [&](handler& h) {
                      const accessor a{b, h, write_only};
                      h.fill(a, 1);
                      h.fill(a, 2);
                    }),
            "one action"));
}

TEST_CASE("copies and fills do what their names say") {
  queue& q = test::queue();
  buffer<int> a(100), b(150);
  q.submit([&](handler& h) { h.fill(accessor{a, h, write_only, no_init}, 7); });
  q.submit([&](handler& h) { h.fill(accessor{b, h, write_only, no_init}, -1); });
  q.submit([&](handler& h) { h.copy(accessor{a, h, read_only}, accessor{b, h, write_only}); });
  ints expected(150, -1);
  std::fill(expected.begin(), expected.begin() + 100, 7);
  ints found(150);
  q.submit([&](handler& h) { h.copy(accessor{b, h, read_only}, found.data()); }).wait_and_throw();
  CHECK(found == expected);
  found.assign(150, 11);
  q.submit([&](handler& h) { h.copy(found.data(), accessor{b, h, write_only}); }).wait_and_throw();
  CHECK(test::contents(b) == ints(150, 11));
  CHECK_THROWS_WITH_AS(q.submit([&](handler& h) {
    h.copy(accessor{b, h, read_only}, accessor{a, h, write_only});
  }),
                       doctest::Contains("600 bytes into 400"), exception);

  buffer<std::array<float, 4>> wide(5);
  q.submit([&](handler& h) { h.fill(accessor{wide, h, write_only}, {1, 2, 3, 4}); });
  const host_accessor w{wide, read_only};
  CHECK(w[4] == std::array<float, 4>{1, 2, 3, 4});
}

TEST_CASE("what the group throws comes out of submit, and nothing runs") {
  const buffer<int> b(8);
  test::set(test::queue(), b, 3);
  CHECK_THROWS_AS(test::queue().submit([&](handler& h) {
    h.fill(accessor{b, h, write_only}, 4);
    throw std::logic_error("the caller's own");
  }),
                  std::logic_error);
  CHECK(test::contents(b) == ints(8, 3));
}
