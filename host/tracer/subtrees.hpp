// Where the largest subtrees of a radix tree begin that have at most FACET_SWEEP_MOST places
// (cl/subtrees.cl).
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/program_set.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

class subtrees {
 public:
  subtrees(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// Lists them for `count` > 0 sorted codes and returns how many there are: subtree k has the
  /// places starts()[k] to starts()[k + 1] - 1. Waits for the device.
  std::uint32_t list(runtime::buffer<std::uint32_t>& codes, std::uint32_t count,
                     std::vector<step>& steps);
  runtime::buffer<std::uint32_t>& starts() { return starts_; }

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  std::uint32_t group_, each_, scan_group_;
  runtime::buffer<std::uint32_t> marks_{1}, counts_{1}, starts_{1}, total_{1};
  runtime::program program_;
  runtime::kernel mark_, scan_, list_;
};

}  // namespace facet::tracer
