// The radix sort by single work-items, a large tile each: cl/radix_serial.cl, and where it is
// faster the one by buckets.
#pragma once

#include "tracer/bucket_sort.hpp"

namespace facet::tracer {

template <class Key>
class serial_sort : public sort_way<Key> {
 public:
  serial_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  std::vector<step> sort(const sort_request<Key>& r) override;
  void add_programs(program_set& to) const override { to.add(program_); }

  static std::uint64_t scratch_bytes(std::uint32_t count, const sort_tuning& t);

 private:
  struct cut;
  void count(const sort_request<Key>& r, const cut& c, std::vector<step>& steps);
  void scatter(const sort_request<Key>& r, const cut& c, std::vector<step>& steps);

  runtime::queue queue_;
  sort_tuning tuning_;
  runtime::program program_;
  runtime::kernel count_keys_, count_records_, scan_, scatter_keys_, scatter_records_,
      scatter_apart_, take_apart_;
  serial_scratch<Key> scratch_;
  bucket_sort<Key> buckets_;
  runtime::buffer<BucketPlan> no_plan_;
};

extern template class serial_sort<std::uint32_t>;
extern template class serial_sort<std::uint64_t>;

}  // namespace facet::tracer
