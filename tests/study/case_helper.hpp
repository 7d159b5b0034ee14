// A hard case at the size of a unit test: it is met, and its mistake is not.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>

#include "sanitized.hpp"
#include "study/cases/cases.hpp"
#include "study/cases/report.hpp"
#include "tracer/device_helper.hpp"

namespace facet::test {

inline void check_case(int number) {
  study::lab l{queue()};
  l.rays = fewer(10000);
  l.threads = 2;
  for (const study::hard_case& c : study::hard_cases()) {
    if (c.number != number) continue;
    const study::case_report right = study::run_case(c, l, false);
    INFO(study::table_row(right, nullptr, false));
    CHECK(right.is_met());
    if (is_sanitized) return;  // what else there is to find is in the kernels
    const study::case_report wrong = study::run_case(c, l, true);
    CAPTURE(wrong.mistake);
    CHECK(wrong.failures() > 0);
    return;
  }
  FAIL("there is no case ", number);
}

}  // namespace facet::test
