#include "runtime/program.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "runtime/fixture_helper.hpp"

using namespace facet;
using namespace facet::runtime;

TEST_CASE("options specialise a program") {
  const std::string text = "__kernel void answer(__global int* x) { *x = ANSWER; }";
  for (int answer : {1, 42}) {
    const program p = test::program_of(text, "-DANSWER=" + std::to_string(answer));
    CHECK(p.options().starts_with("-DANSWER="));
    CHECK(p.build_ms() > 0);
    buffer<int> x(1);
    test::queue().submit([&](handler& h) {
      h.set_args(accessor{x, h, write_only});
      h.single_task(p.get_kernel("answer"));
    });
    CHECK(test::contents(x)[0] == answer);
  }
}

TEST_CASE("a build failure holds options, log, and the file and line of an included mistake") {
  const source_tree sources{
      {{"main.cl", "#include \"lib.h\"\n__kernel void k(__global int* x) { *x = f(); }\n"},
       {"lib.h", "\n\nint f(void) { return no_such_name; }\n"}}};
  try {
    const program p(test::queue().get_context(), sources, "main.cl", "-DFLAVOUR=7");
    FAIL("it compiled");
  } catch (const exception& e) {
    const std::string message = e.what();
    CAPTURE(message);
    CHECK(e.code() == errc::build);
    CHECK(e.cl_code() != 0);
    CHECK(message.find("clBuildProgram") != std::string::npos);
    CHECK(message.find("-DFLAVOUR=7") != std::string::npos);
    CHECK(message.find("no_such_name") != std::string::npos);
    CHECK(message.find("lib.h:3") != std::string::npos);
  }
}

TEST_CASE("an unknown kernel is refused with the names there are") {
  const program p = test::program_of(
      "__kernel void first(__global int* x) {}\n__kernel void second(__global int* x, int y) {}");
  auto names = p.kernel_names();
  std::sort(names.begin(), names.end());
  CHECK(names == std::vector<std::string>{"first", "second"});
  CHECK(p.get_kernel("second").num_args() == 2);
  CHECK(p.get_kernel("second").name() == "second");
  try {
    p.get_kernel("third");
    FAIL("it was found");
  } catch (const exception& e) {
    CHECK(e.code() == errc::kernel);
    for (const char* part : {"third", "first", "second"})
      CHECK(std::string(e.what()).find(part) != std::string::npos);
  }
}

TEST_CASE("a kernel knows its limits as compiled") {
  const device d = test::device();
  const kernel k = test::program_of(
                       "__kernel void k(__global int* x) {\n"
                       "  __local int room[256];\n"
                       "  const size_t l = get_local_id(0);\n"
                       "  room[l] = x[l];\n"
                       "  barrier(CLK_LOCAL_MEM_FENCE);\n"
                       "  x[l] = room[get_local_size(0) - 1 - l];\n"
                       "}")
                       .get_kernel("k");
  CHECK(k.work_group_size(d) >= 1);
  CHECK(k.work_group_size(d) <= d.max_work_group_size());
  CHECK(k.preferred_work_group_size_multiple(d) >= 1);
  CHECK(k.local_mem_size(d) >= 256 * 4);
}

TEST_CASE("a program outlives the tree that it was made of, a kernel the program") {
  const kernel k = test::program_of("__kernel void k(__global int* x) { *x = 3; }").get_kernel("k");
  buffer<int> x(1);
  test::queue().submit([&](handler& h) {
    h.set_args(accessor{x, h, write_only});
    h.single_task(k);
  });
  CHECK(test::contents(x)[0] == 3);
}

TEST_CASE("a kernel of another context is refused") {
  const queue other(context(test::device()), test::device());
  buffer<int> x(1);
  queue q = other;
  CHECK_THROWS_AS(test::set(q, x, 1), exception);
}
