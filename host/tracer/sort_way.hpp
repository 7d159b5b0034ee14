// What a radix sort is asked for, and what can do it: the two faces of tracer/radix_sort.hpp.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/program_set.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// What a sort is asked for.
template <class Key>
struct sort_request {
  runtime::buffer<Key>& keys;
  runtime::buffer<std::uint32_t>& values;
  std::uint32_t count;
  unsigned bits;        ///< that count, the lowest; at least 1
  bool is_first_order;  ///< values are 0, 1, 2, ... and not read
};

/// tracer/group_sort.hpp or tracer/serial_sort.hpp.
template <class Key>
class sort_way {
 public:
  virtual ~sort_way() = default;
  virtual std::vector<step> sort(const sort_request<Key>& r) = 0;
  virtual void add_programs(program_set& to) const = 0;
};

}  // namespace facet::tracer
