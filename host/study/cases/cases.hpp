// The hard cases: one table. Each is a geometry that breaks plain tracers, an oracle that knows the
// answer, and a mistake that the case is shown to catch.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "study/cases/lab.hpp"

namespace facet::study {

struct hard_case {
  int number;
  const char* name;
  bool counts_rays;  ///< its oracle follows any number of rays
  void (*run)(lab&);
  mistake (*wrong)();
};

/// By number, 1 to 26.
std::span<const hard_case> hard_cases();

struct case_report {
  int number;
  std::string name;
  std::string mistake;  ///< that was in the tracer; empty: none
  std::vector<finding> findings;
  double seconds;

  bool is_met() const;
  std::uint64_t failures() const;  ///< of the findings that are goals
};

/// Runs one case; `with_mistake` puts the case's own mistake into the tracer under test.
case_report run_case(const hard_case& c, lab l, bool with_mistake);

}  // namespace facet::study
