// Stable LSD radix sort on the device: keys of 32 or 64 bits, each with a 32-bit value.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Key is std::uint32_t or std::uint64_t (cl/radix_sort.cl).
template <class Key>
class radix_sort {
 public:
  radix_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// Sorts the first `count` keys by their lowest `bits` bits, ascending and stable; values move
  /// with their keys. The two buffers may have changed places with scratch ones of the same size
  /// when this returns: use the references. Nothing is waited for.
  void sort(runtime::buffer<Key>& keys, runtime::buffer<std::uint32_t>& values, std::uint32_t count,
            unsigned bits = 8 * sizeof(Key));

  double compile_ms() const { return program_.build_ms(); }

 private:
  runtime::queue queue_;
  tuning tuning_;
  runtime::program program_;
  runtime::kernel count_, scan_, scatter_;
};

extern template class radix_sort<std::uint32_t>;
extern template class radix_sort<std::uint64_t>;

}  // namespace facet::tracer
