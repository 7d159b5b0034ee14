#include "tracer/look_back.hpp"

#include <doctest/doctest.h>

#include "tracer/device_helper.hpp"
#include "tracer/kernels.hpp"

using namespace facet;
using namespace facet::tracer;

TEST_CASE("groups whose ids a counter hands out can look back at those before them") {
  CHECK(has_look_back(test::queue(), kernel_sources(), tuning_for(test::device())));
}

TEST_CASE("the proof fails, and ends, where groups wait for groups that have not started") {
  CHECK_FALSE(prove_look_back(test::queue(), kernel_sources(), tuning_for(test::device()), 1000,
                              " -DFACET_LOOK_BACK_REVERSED"));
}
