// Stable LSD radix sort on the device: keys of 32 or 64 bits, each with a 32-bit value.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/sort_way.hpp"

namespace facet::tracer {

/// Key is std::uint32_t or std::uint64_t. Its scratch memory is kept from sort to sort, and grows
/// when more is needed.
template <class Key>
class radix_sort {
 public:
  static constexpr std::uint32_t most_keys = (1u << 30) - 1;

  radix_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// Sorts the first `count` keys by their lowest `bits` bits, ascending and stable; values move
  /// with their keys. The two buffers may have changed places with scratch ones of at least `count`
  /// elements when this returns: use the references. Nothing is waited for. Throws errc::invalid
  /// for more than most_keys keys, for bits that are 0 or more than a key's, for buffers that hold
  /// less.
  std::vector<step> sort(runtime::buffer<Key>& keys, runtime::buffer<std::uint32_t>& values,
                         std::uint32_t count, unsigned bits = 8 * sizeof(Key));

  /// The same with values that start as 0, 1, 2, ...: what the buffer holds is not read. values[i]
  /// is then where the i-th of the sorted keys was.
  std::vector<step> sort_order(runtime::buffer<Key>& keys, runtime::buffer<std::uint32_t>& values,
                               std::uint32_t count, unsigned bits = 8 * sizeof(Key));

  /// Bytes of device memory, at most, that a sort of `count` keys keeps beside keys and values.
  static std::uint64_t scratch_bytes(std::uint32_t count, const sort_tuning& t);

  void add_programs(program_set& to) const { way_->add_programs(to); }

 private:
  std::vector<step> sort(const sort_request<Key>& r);

  std::unique_ptr<sort_way<Key>> way_;
};

extern template class radix_sort<std::uint32_t>;
extern template class radix_sort<std::uint64_t>;

}  // namespace facet::tracer
