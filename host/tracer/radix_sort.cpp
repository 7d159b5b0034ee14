#include "tracer/radix_sort.hpp"

#include <string>

#include "tracer/group_sort.hpp"
#include "tracer/launch.hpp"
#include "tracer/serial_sort.hpp"

namespace facet::tracer {
namespace {

template <class Key>
std::unique_ptr<sort_way<Key>> way_of(const runtime::queue& q, const runtime::source_tree& kernels,
                                      const tuning& t) {
  if (t.sort.face == sort_face::group) return std::make_unique<group_sort<Key>>(q, kernels, t);
  return std::make_unique<serial_sort<Key>>(q, kernels, t);
}

}  // namespace

template <class Key>
radix_sort<Key>::radix_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : way_(way_of<Key>(q, kernels, t)) {}

template <class Key>
std::vector<step> radix_sort<Key>::sort(runtime::buffer<Key>& keys,
                                        runtime::buffer<std::uint32_t>& values, std::uint32_t count,
                                        unsigned bits) {
  return sort({keys, values, count, bits, false});
}

template <class Key>
std::vector<step> radix_sort<Key>::sort_order(runtime::buffer<Key>& keys,
                                              runtime::buffer<std::uint32_t>& values,
                                              std::uint32_t count, unsigned bits) {
  return sort({keys, values, count, bits, true});
}

template <class Key>
std::vector<step> radix_sort<Key>::sort(const sort_request<Key>& r) {
  const auto refuse = [](const std::string& why) {
    throw runtime::exception(runtime::errc::invalid, "a radix sort " + why);
  };
  if (r.count > most_keys)
    refuse("of " + std::to_string(r.count) + " keys; at most " + std::to_string(most_keys) +
           " are allowed");
  if (r.bits == 0 || r.bits > 8 * sizeof(Key))
    refuse("by " + std::to_string(r.bits) + " bits; 1 to " + std::to_string(8 * sizeof(Key)) +
           " are allowed");
  if (r.keys.size() < r.count || r.values.size() < r.count)
    refuse("of " + std::to_string(r.count) + " keys in buffers of " +
           std::to_string(r.keys.size()) + " keys and " + std::to_string(r.values.size()) +
           " values");
  if (r.count == 0) return {};
  return way_->sort(r);
}

template <class Key>
std::uint64_t radix_sort<Key>::scratch_bytes(std::uint32_t count, const sort_tuning& t) {
  return t.face == sort_face::group ? group_sort<Key>::scratch_bytes(count, t)
                                    : serial_sort<Key>::scratch_bytes(count, t);
}

template class radix_sort<std::uint32_t>;
template class radix_sort<std::uint64_t>;

}  // namespace facet::tracer
