// Primitives in the order of a Morton curve, and the largest subtrees of the radix tree over them:
// what trees are built from. In steps (morton.hpp, radix_sort.hpp, subtrees.hpp), or for few
// primitives of a CPU by one work-item (cl/order_few.cl).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/morton.hpp"
#include "tracer/program_set.hpp"
#include "tracer/radix_sort.hpp"
#include "tracer/subtrees.hpp"

namespace facet::tracer {

/// Primitive is texel (triangles, three corners a row) or Box.
template <class Primitive>
class curve_order {
 public:
  /// `kernels` outlive this.
  curve_order(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// Compiles what so many primitives take.
  void prepare(std::uint32_t count);

  /// The curve through `count` > 0 primitives; their codes, sorted, of which there is room for at
  /// least `count`, and in `order` the primitive of each. Returns how many subtrees there are, as
  /// subtrees::list does. Waits for the device.
  std::uint32_t make(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                     runtime::buffer<Curve>& curve, runtime::buffer<std::uint32_t>& codes,
                     runtime::buffer<std::uint32_t>& order, std::vector<step>& steps);
  /// Of the last make().
  runtime::buffer<std::uint32_t>& starts() { return *starts_; }

  void add_programs(program_set& to) const;

 private:
  struct in_steps {
    morton<Primitive> curve;
    radix_sort<std::uint32_t> sort;
    subtrees cut;
  };
  struct at_once {
    runtime::program program;
    runtime::kernel kernel;
    std::array<runtime::buffer<std::uint64_t>, 2> records{runtime::buffer<std::uint64_t>(1),
                                                          runtime::buffer<std::uint64_t>(1)};
    runtime::buffer<std::uint32_t> starts{1}, total{1};
  };
  std::uint32_t make_at_once(runtime::buffer<Primitive>& primitives, std::uint32_t count,
                             runtime::buffer<Curve>& curve, runtime::buffer<std::uint32_t>& codes,
                             runtime::buffer<std::uint32_t>& order, std::vector<step>& steps);

  runtime::queue queue_;
  const runtime::source_tree& kernels_;
  tuning tuning_;
  std::uint32_t few_;  ///< primitives that one work-item is as fast with
  std::optional<at_once> at_once_;
  std::optional<in_steps> in_steps_;
  runtime::buffer<std::uint32_t>* starts_ = nullptr;
};

extern template class curve_order<texel>;
extern template class curve_order<Box>;

}  // namespace facet::tracer
