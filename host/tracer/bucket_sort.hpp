// The sort by buckets that fit a core's caches, for devices whose work-items are a CPU's threads:
// cl/radix_buckets.cl, with all that puts primitives in order in one program (cl/serial_order.cl).
#pragma once

#include <array>
#include <string>

#include "cl/build_layout.h"
#include "tracer/sort_way.hpp"

namespace facet::tracer {

/// key << 32 | value, or ulong2 (cl/sort_record.h).
template <class Key>
struct sort_record {
  Key key;
  std::uint32_t value;
};
static_assert(sizeof(sort_record<std::uint32_t>) == 8 && sizeof(sort_record<std::uint64_t>) == 16);

/// What the sorts by single work-items work in: a tile's counts, and records from pass to pass.
template <class Key>
struct serial_scratch {
  static constexpr std::uint32_t digits = 2048;  ///< that a tile is counted by

  runtime::buffer<std::uint32_t> counts{0};
  std::array<runtime::buffer<sort_record<Key>>, 2> records{runtime::buffer<sort_record<Key>>(0),
                                                           runtime::buffer<sort_record<Key>>(0)};
};

/// The program's options. Trees are built by 32-bit keys, and share it.
template <class Key>
std::string key_options() {
  return sizeof(Key) == 4 ? "" : " -DKEY_BITS=64";
}

/// How keys are shared out among work-items, in order.
struct sort_tiles {
  std::uint32_t size, count;

  runtime::nd_range<1> range() const { return {runtime::range<1>(count), runtime::range<1>(1)}; }
};

template <class Key>
class bucket_sort {
 public:
  bucket_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// By one work-item.
  void sort_few(const sort_request<Key>& r, serial_scratch<Key>& in, std::vector<step>& steps);

  /// Sorts, unless plan() says on the device that the keys do not spread over buckets; then they
  /// stay as they are.
  void sort(const sort_request<Key>& r, sort_tiles tiles, serial_scratch<Key>& in,
            std::vector<step>& steps);

  /// Of the last sort().
  runtime::buffer<BucketPlan>& plan() { return plan_; }
  /// Whether so many keys are sorted however they are.
  bool sorts_any(std::uint32_t count) const { return count <= tuning_.bucket_most; }

  void add_programs(program_set& to) const { to.add(program_); }
  static std::uint64_t scratch_bytes(std::uint32_t count, const sort_tuning& t);

 private:
  void choose(const sort_request<Key>& r, std::vector<step>& steps);
  void scatter(const sort_request<Key>& r, sort_tiles tiles, serial_scratch<Key>& in,
               std::vector<step>& steps);
  void sort_each(const sort_request<Key>& r, sort_tiles tiles, serial_scratch<Key>& in,
                 std::vector<step>& steps);

  runtime::queue queue_;
  sort_tuning tuning_;
  runtime::program program_;
  runtime::kernel choose_, count_, scan_, scatter_, sort_, sort_few_;
  runtime::buffer<BucketPlan> plan_{1};
  runtime::buffer<sort_record<Key>> cached_{0};
};

extern template class bucket_sort<std::uint32_t>;
extern template class bucket_sort<std::uint64_t>;

}  // namespace facet::tracer
