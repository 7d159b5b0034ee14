#include "tracer/program_set.hpp"

#include <doctest/doctest.h>

#include "tracer/device_helper.hpp"

using namespace facet;
using namespace facet::tracer;

TEST_CASE("a program that several parts share counts once") {
  const auto with = [](const char* name) {
    return runtime::program(
        test::queue().get_context(),
        {{{"k.cl", std::string("__kernel void ") + name + "(__global int* x) { *x = 1; }\n"}}},
        "k.cl");
  };
  const runtime::program a = with("a"), b = with("b"), again = a;
  program_set set;
  CHECK(set.build_ms() == 0);
  set.add(a), set.add(b), set.add(again), set.add(b);
  CHECK(set.build_ms() == a.build_ms() + b.build_ms());
}
