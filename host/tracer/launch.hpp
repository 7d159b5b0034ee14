// The ranges of kernels.
#pragma once

#include <algorithm>
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

/// The same of two dimensions.
inline runtime::nd_range<2> padded(std::size_t columns, std::size_t rows, runtime::range<2> group) {
  const auto whole = [](std::size_t count, std::size_t size) {
    return std::max<std::size_t>(1, (count + size - 1) / size) * size;
  };
  return {runtime::range<2>(whole(columns, group[0]), whole(rows, group[1])), group};
}

/// So many groups of that size.
inline runtime::nd_range<1> in_groups(std::size_t groups, std::uint32_t group) {
  return {runtime::range<1>(groups * group), runtime::range<1>(group)};
}

}  // namespace facet::tracer
