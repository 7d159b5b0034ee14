#include "runtime/error.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace facet::runtime;

TEST_CASE("codes have the names of OpenCL's headers") {
  CHECK(std::string(code_name(-5)) == "CL_OUT_OF_RESOURCES");
  CHECK(std::string(code_name(-54)) == "CL_INVALID_WORK_GROUP_SIZE");
  CHECK(std::string(code_name(0)) == "CL_SUCCESS");
  CHECK(std::string(code_name(-1001)) == "CL_PLATFORM_NOT_FOUND_KHR");
  CHECK(std::string(code_name(-12345)) == "unknown OpenCL code");
}

TEST_CASE("a failed allocation is told from other failures") {
  CHECK(errc_of(-4) == errc::memory_allocation);
  CHECK(errc_of(-6) == errc::memory_allocation);
  CHECK(errc_of(-5) == errc::runtime);
  CHECK(errc_of(-54) == errc::nd_range);
  CHECK(errc_of(-52) == errc::kernel_argument);
  CHECK(errc_of(-11) == errc::build);
  CHECK(errc_of(-12345) == errc::runtime);
}

TEST_CASE("a failed call's message holds call, code's name, code and place") {
  const exception e = failed_call("clCreateBuffer", -61, "7 bytes");
  CHECK(std::string(e.what()) == "clCreateBuffer: CL_INVALID_BUFFER_SIZE (-61), 7 bytes");
  CHECK(e.cl_code() == -61);
  CHECK(exception(errc::invalid, "x").cl_code() == 0);
}
