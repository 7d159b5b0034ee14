// Ranges, groups and local memory, as they reach the kernel and as they are refused.
#include "runtime/handler.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

using ints = std::vector<int>;

namespace {

const program& kernels() {
  static const program p = test::program_of(R"(
__kernel void count(__global int* hits, int width, int height) {
  const int i = (int)(get_global_id(0) + width * (get_global_id(1) + height * get_global_id(2)));
  hits[i] += 1;
}
__kernel void groups(__global int* to) {
  to[get_global_id(0)] = (int)(1000 * get_group_id(0) + get_local_id(0));
}
__kernel void reverse(__global const int* from, __global int* to, __local int* room) {
  const size_t l = get_local_id(0), n = get_local_size(0);
  room[l] = from[get_global_id(0)];
  barrier(CLK_LOCAL_MEM_FENCE);
  to[get_global_id(0)] = room[n - 1 - l];
}
__kernel __attribute__((reqd_work_group_size(4, 1, 1))) void by_four(__global int* to) {
  to[get_global_id(0)] = (int)get_local_size(0);
}
)");
  return p;
}

template <class Range>
std::string refusal(const Range& r, const kernel& k, errc code = errc::nd_range) {
  const buffer<int> b(64);
  try {
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{b, h, write_only});
      h.parallel_for(r, k);
    });
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

TEST_CASE("a range launches each work-item once, in 1, 2 and 3 dimensions, of any size") {
  const auto check = [](auto r, int width, int height) {
    buffer<int> hits(r.size());
    test::queue().submit([&](handler& h) { h.fill(accessor{hits, h, write_only}, 0); });
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{hits, h, read_write}, width, height);
      h.parallel_for(r, kernels().get_kernel("count"));
    });
    CHECK(test::contents(hits) == ints(r.size(), 1));
  };
  check(range(1), 1, 1);
  check(range(1009), 1009, 1);
  check(range(13, 17), 13, 17);
  check(range(3, 5, 7), 3, 5);
}

TEST_CASE("dimension 0 of a range is get_global_id(0)") {
  buffer<int> hits(6);
  test::queue().submit([&](handler& h) { h.fill(accessor{hits, h, write_only}, 0); });
  // 2 by 1 of a picture 3 wide.
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{hits, h, read_write}, 3, 2);
    h.parallel_for(range(2, 1), kernels().get_kernel("count"));
  });
  CHECK(test::contents(hits) == ints{1, 1, 0, 0, 0, 0});
}

TEST_CASE("an offset is added to the global ids") {
  buffer<int> hits(10);
  test::queue().submit([&](handler& h) { h.fill(accessor{hits, h, write_only}, 0); });
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{hits, h, read_write}, 10, 1);
    h.parallel_for(nd_range<1>({4}, {2}, {5}), kernels().get_kernel("count"));
  });
  CHECK(test::contents(hits) == ints{0, 0, 0, 0, 0, 1, 1, 1, 1, 0});
}

TEST_CASE("an nd_range is cut into groups of its local size") {
  buffer<int> b(6);
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{b, h, write_only});
    h.parallel_for(nd_range<1>({6}, {3}), kernels().get_kernel("groups"));
  });
  CHECK(test::contents(b) == ints{0, 1, 2, 1000, 1001, 1002});
  CHECK(nd_range<2>({12, 6}, {4, 6}).get_group_range() == range<2>(3, 1));
}

TEST_CASE("a range with a 0 launches nothing, and its event completes") {
  buffer<int> b(4);
  test::set(test::queue(), b, 3);
  test::queue()
      .submit([&](handler& h) {
        h.set_args(accessor{b, h, read_write}, 1, 1);
        h.parallel_for(range(4, 0), kernels().get_kernel("count"));
      })
      .wait_and_throw();
  CHECK(test::contents(b) == ints(4, 3));
}

TEST_CASE("local memory is shared by a group, and each launch has its own size of it") {
  for (std::size_t group : {1u, 2u, 8u}) {
    ints from(16);
    std::iota(from.begin(), from.end(), 0);
    const buffer<int> in(from.data(), from.size());
    buffer<int> out(16);
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{in, h, read_only}, accessor{out, h, write_only},
                 local_accessor<int>(group, h));
      h.parallel_for(nd_range<1>({16}, {group}), kernels().get_kernel("reverse"));
    });
    for (std::size_t i = 0; i < 16; i += group)
      std::reverse(from.begin() + std::ptrdiff_t(i), from.begin() + std::ptrdiff_t(i + group));
    CHECK(test::contents(out) == from);
  }
}

TEST_CASE("more local memory than the device has is refused with both figures") {
  const std::uint64_t most = test::device().local_mem_size();
  const buffer<int> b(8);
  try {
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{b, h, read_only}, accessor{b, h, write_only},
                 local_accessor<char>(most + 4, h));
      h.parallel_for(nd_range<1>({8}, {8}), kernels().get_kernel("reverse"));
    });
    FAIL("not refused");
  } catch (const exception& e) {
    CHECK(e.code() == errc::memory_allocation);
    CHECK(has(e.what(), std::to_string(most)));
    CHECK(has(e.what(), "'reverse'"));
  }
}

TEST_CASE("a work-group larger than the kernel allows is refused with the kernel's figure") {
  const kernel k = kernels().get_kernel("groups");
  const std::size_t most = k.work_group_size(test::device());
  CHECK(most >= 1);
  const std::string message = refusal(nd_range<1>({8 * most}, {2 * most}), k);
  CHECK(has(message, "'groups'"));
  CHECK(has(message, std::to_string(2 * most)));
  CHECK(has(message, std::to_string(most)));
  // Each dimension is within limits, and the product is not.
  const auto sizes = test::device().max_work_item_sizes();
  if (sizes[0] >= most && sizes[1] >= 2)
    CHECK(has(refusal(nd_range<2>({most, 2}, {most, 2}), k), std::to_string(2 * most)));
}

TEST_CASE("a work-group longer than a dimension allows is refused with the device's figure") {
  const std::size_t most = test::device().max_work_item_sizes()[2];
  const std::string message =
      refusal(nd_range<3>({1, 1, most + 1}, {1, 1, most + 1}), kernels().get_kernel("groups"));
  CHECK(has(message, "dimension 2"));
  CHECK(has(message, std::to_string(most)));
}

TEST_CASE("a work-group that does not divide the range, or is empty, is refused") {
  const kernel k = kernels().get_kernel("groups");
  const std::string message = refusal(nd_range<2>({7, 4}, {2, 2}), k);
  CHECK(has(message, "7x4"));
  CHECK(has(message, "2x2"));
  CHECK(has(refusal(nd_range<1>({7}, {0}), k), "empty"));
}

TEST_CASE("a work-group size that the kernel requires is kept, or filled in") {
  const kernel k = kernels().get_kernel("by_four");
  CHECK(has(refusal(nd_range<1>({8}, {2}), k), "requires 4x1x1"));
  CHECK(has(refusal(range(7), k), "no multiple"));
  buffer<int> b(8);
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{b, h, write_only});
    h.parallel_for(range(8), k);
  });
  CHECK(test::contents(b) == ints(8, 4));
}
