#include "tracer/radix_sort.hpp"

#include <algorithm>
#include <utility>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr unsigned digit_bits = 8;
constexpr std::uint32_t digits = 1u << digit_bits;

}  // namespace

template <class Key>
radix_sort<Key>::radix_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      tuning_(t),
      program_(compiled(q, kernels, "radix_sort.cl",
                        t.flags() + (sizeof(Key) == 8 ? " -DKEY=ulong" : " -DKEY=uint"))),
      count_(program_.get_kernel("count_digits")),
      scan_(program_.get_kernel("scan_digits")),
      scatter_(program_.get_kernel("scatter")) {}

template <class Key>
void radix_sort<Key>::sort(runtime::buffer<Key>& keys, runtime::buffer<std::uint32_t>& values,
                           std::uint32_t count, unsigned bits) {
  if (count < 2) return;
  const std::uint32_t tile =
      std::max(tuning_.sort_tile_least, (count + tuning_.sort_tiles - 1) / tuning_.sort_tiles);
  const std::uint32_t tiles = (count + tile - 1) / tile;
  runtime::buffer<Key> keys_out(keys.size());
  runtime::buffer<std::uint32_t> values_out(values.size());
  runtime::buffer<std::uint32_t> counts(std::size_t(tiles) * digits);
  const auto range = padded(tiles, std::min(tiles, 32u));
  for (std::uint32_t shift = 0; shift < bits; shift += digit_bits) {
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor in{keys, h, runtime::read_only};
      const runtime::accessor out{counts, h, runtime::write_only};
      h.set_args(in, out, count, tile, shift);
      h.parallel_for(range, count_);
    });
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor all{counts, h, runtime::read_write};
      h.set_args(all, tiles);
      h.parallel_for(runtime::nd_range<1>(runtime::range<1>(digits), runtime::range<1>(digits)),
                     scan_);
    });
    queue_.submit([&](runtime::handler& h) {
      const runtime::accessor keys_in{keys, h, runtime::read_only};
      const runtime::accessor values_in{values, h, runtime::read_only};
      const runtime::accessor places{counts, h, runtime::read_only};
      const runtime::accessor to_keys{keys_out, h, runtime::write_only};
      const runtime::accessor to_values{values_out, h, runtime::write_only};
      h.set_args(keys_in, values_in, places, to_keys, to_values, count, tile, shift);
      h.parallel_for(range, scatter_);
    });
    std::swap(keys, keys_out);
    std::swap(values, values_out);
  }
}

template class radix_sort<std::uint32_t>;
template class radix_sort<std::uint64_t>;

}  // namespace facet::tracer
