// The ranges of one-dimensional kernels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/runtime.hpp"

namespace facet::tracer {

/// For a kernel that guards its index: at least `count` work-items, at least one group, in whole
/// groups of `group`.
inline runtime::nd_range<1> padded(std::size_t count, std::uint32_t group) {
  const std::size_t groups = count == 0 ? 1 : (count + group - 1) / group;
  return {runtime::range<1>(groups * group), runtime::range<1>(group)};
}

/// So many groups of that size.
inline runtime::nd_range<1> in_groups(std::size_t groups, std::uint32_t group) {
  return {runtime::range<1>(groups * group), runtime::range<1>(group)};
}

}  // namespace facet::tracer
