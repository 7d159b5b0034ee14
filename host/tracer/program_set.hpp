// The programs that something is done by, each once: many parts share one.
#pragma once

#include <vector>

#include "runtime/program.hpp"

namespace facet::tracer {

class program_set {
 public:
  void add(const runtime::program& p);
  /// What compiling them took.
  double build_ms() const;

 private:
  std::vector<runtime::program> all_;
};

}  // namespace facet::tracer
