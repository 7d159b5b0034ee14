#include "runtime/image.hpp"

#include <doctest/doctest.h>

#include <array>
#include <vector>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

namespace {

using texel = std::array<float, 4>;

const program& kernels() {
  static const program p = test::program_of(R"(
__kernel void paint(__write_only image2d_t to) {
  const int2 at = (int2)((int)get_global_id(0), (int)get_global_id(1));
  write_imagef(to, at, (float4)((float)at.x, (float)at.y, 0.5f, -1.0f));
}
__constant sampler_t exact = CLK_NORMALIZED_COORDS_FALSE | CLK_ADDRESS_NONE | CLK_FILTER_NEAREST;
__kernel void look(__read_only image2d_t from, __global float4* to) {
  const int2 at = (int2)((int)get_global_id(0), (int)get_global_id(1));
  to[at.y * get_image_width(from) + at.x] = read_imagef(from, exact, at);
}
)");
  return p;
}

std::vector<texel> numbered(std::size_t count) {
  std::vector<texel> t(count);
  for (std::size_t i = 0; i < count; ++i) t[i] = {float(i), float(i) + 0.25f, -float(i), 1e30f};
  return t;
}

std::vector<texel> contents(const buffer<texel>& b) {
  const host_accessor read{b, read_only};
  return {read.begin(), read.end()};
}

/// What a kernel sees of an image.
std::vector<texel> looked_at(const image2d& image) {
  buffer<texel> seen(image.width() * image.height());
  test::queue().submit([&](handler& h) {
    h.set_args(image_accessor{image, h, read_only}, accessor{seen, h, write_only});
    h.parallel_for(range(image.width(), image.height()), kernels().get_kernel("look"));
  });
  return contents(seen);
}

}  // namespace

TEST_CASE("images hold RGBA floats exactly") {
  if (!test::device().image_support()) return;
  constexpr std::size_t width = 13, height = 7;
  SUBCASE("from the host") {
    const std::vector<texel> t = numbered(width * height);
    CHECK(looked_at(image2d(t[0].data(), width, height)) == t);
  }
  SUBCASE("from a buffer") {
    const std::vector<texel> t = numbered(width * height + 5);
    const buffer<texel> b(t.data(), t.size());
    const image2d image(width, height);
    test::queue().submit([&](handler& h) {
      h.copy(accessor{b, h, read_only}, image_accessor{image, h, write_only});
    });
    CHECK(looked_at(image) == std::vector<texel>(t.begin(), t.begin() + width * height));
  }
  SUBCASE("from a kernel, copied to a buffer") {
    const image2d image(width, height);
    test::queue().submit([&](handler& h) {
      h.set_args(image_accessor{image, h, write_only});
      h.parallel_for(range(width, height), kernels().get_kernel("paint"));
    });
    buffer<texel> b(width * height);
    test::queue().submit([&](handler& h) {
      h.copy(image_accessor{image, h, read_only}, accessor{b, h, write_only});
    });
    const std::vector<texel> found = contents(b);
    CHECK(found[2 * width + 5] == texel{5, 2, 0.5f, -1});
    CHECK(found == looked_at(image));
  }
}

TEST_CASE("images take part in dependencies") {
  if (!test::device().image_support()) return;
  queue q(test::device(), {.out_of_order = true});
  const image2d image(8, 8);
  buffer<texel> seen(64);
  const event paint = q.submit([&](handler& h) {
    h.set_args(image_accessor{image, h, write_only});
    h.parallel_for(range(8, 8), kernels().get_kernel("paint"));
  });
  const event look = q.submit([&](handler& h) {
    h.set_args(image_accessor{image, h, read_only}, accessor{seen, h, write_only});
    h.parallel_for(range(8, 8), kernels().get_kernel("look"));
  });
  REQUIRE(look.get_wait_list().size() == 1);
  CHECK(look.get_wait_list()[0].get() == paint.get());
  CHECK(contents(seen)[9] == texel{1, 1, 0.5f, -1});
}

TEST_CASE("an image is read or written as its qualifier says") {
  if (!test::device().image_support()) return;
  const image2d image(8, 8);
  const buffer<texel> b(64);
  CHECK_THROWS_WITH_AS(test::queue().submit([&](handler& h) {
    h.set_args(image_accessor{image, h, read_only});
    h.parallel_for(range(8, 8), kernels().get_kernel("paint"));
  }),
                       doctest::Contains("read_only accessor"), exception);
  CHECK_THROWS_WITH_AS(test::queue().submit([&](handler& h) {
    h.set_args(accessor{b, h, write_only});
    h.parallel_for(range(8, 8), kernels().get_kernel("paint"));
  }),
                       doctest::Contains("was given an accessor"), exception);
}

TEST_CASE("sizes that cannot be are refused with what was found and what is allowed") {
  CHECK_THROWS_WITH_AS(image2d(0, 4), doctest::Contains("0x4"), exception);
  CHECK_THROWS_AS(image2d(~std::size_t(0), 2), exception);
  const device d = test::device();
  if (!d.image_support()) return;
  const image2d wide(d.image2d_max_width() + 1, 1);
  try {
    test::queue().submit([&](handler& h) {
      h.set_args(image_accessor{wide, h, write_only});
      h.parallel_for(range(1, 1), kernels().get_kernel("paint"));
    });
    FAIL("not refused");
  } catch (const exception& e) {
    CHECK(e.code() == errc::memory_allocation);
    const std::string message = e.what();
    CHECK(message.find(std::to_string(wide.width()) + "x1") != std::string::npos);
    CHECK(message.find(std::to_string(d.image2d_max_width())) != std::string::npos);
  }
  const buffer<texel> few(3);
  const image2d small(2, 2);
  CHECK_THROWS_AS(test::queue().submit([&](handler& h) {
    h.copy(accessor{few, h, read_only}, image_accessor{small, h, write_only});
  }),
                  exception);
}
