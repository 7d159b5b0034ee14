// Where primitives' centres stand along a Morton curve (cl/morton.cl).
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/pack.hpp"
#include "tracer/program_set.hpp"
#include "tracer/step.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// The compiler's option by which kernels know what they work on (cl/bounds.h).
template <class Primitive>
std::string primitive_options() {
  return std::is_same_v<Primitive, Box> ? " -DFACET_OVER_BOXES" : "";
}

/// What kernels are told instead that single work-items build by: rows of four floats a primitive.
template <class Primitive>
inline constexpr std::uint32_t primitive_rows = std::is_same_v<Primitive, Box> ? 2 : 3;

/// Primitive is texel (triangles, three corners a row) or Box.
template <class Primitive>
class morton {
 public:
  morton(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t);

  /// The curve through `count` > 0 primitives, and codes[i] of primitive i: 32 bits, those of the
  /// longest sides first.
  void codes(runtime::buffer<Primitive>& primitives, runtime::buffer<Curve>& curve,
             runtime::buffer<std::uint32_t>& codes, std::uint32_t count, std::vector<step>& steps);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  bool is_alone_;
  std::uint32_t group_, most_groups_;
  runtime::buffer<Box> partial_;
  runtime::program program_;
  runtime::kernel partial_bounds_, total_bounds_, codes_;
};

extern template class morton<texel>;
extern template class morton<Box>;

}  // namespace facet::tracer
