// The radix sort by work-groups, a tile of keys each: cl/radix_sort.cl.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "tracer/sort_way.hpp"

namespace facet::tracer {

template <class Key>
class group_sort : public sort_way<Key> {
 public:
  group_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  std::vector<step> sort(const sort_request<Key>& r) override;
  void add_programs(program_set& to) const override;

  static std::uint64_t scratch_bytes(std::uint32_t count, const sort_tuning& t);
  /// Keys that a group sorts at a time.
  static std::uint32_t tile_size(const sort_tuning& t);

 private:
  /// Memory that groups meet at, clean.
  void prepare_words(std::uint32_t tiles, std::vector<step>& steps);
  void sort_in_one_launch(const sort_request<Key>& r, std::uint32_t tiles,
                          std::vector<step>& steps);
  void sort_looking_back(const sort_request<Key>& r, std::uint32_t tiles, std::vector<step>& steps);
  void sort_counting(const sort_request<Key>& r, std::uint32_t tiles, std::vector<step>& steps);

  runtime::queue queue_;
  sort_tuning tuning_;
  bool looks_back_;
  std::uint32_t whole_most_;
  runtime::program program_;
  std::optional<runtime::kernel> whole_, scatter_;

  runtime::buffer<Key> keys_{0};
  runtime::buffer<std::uint32_t> values_{0};

  // Looking back. Bins and state are 0 between sorts, unless one of them was cut short.
  std::optional<runtime::kernel> histogram_;
  bool is_clean_ = false;
  runtime::buffer<std::uint32_t> bins_, counters_, state_;
  std::array<runtime::buffer<std::uint32_t>, 2> words_{runtime::buffer<std::uint32_t>(0),
                                                       runtime::buffer<std::uint32_t>(0)};
  // Counting first.
  std::optional<runtime::program> counting_;
  std::optional<runtime::kernel> count_, sum_, scan_;
  runtime::buffer<std::uint32_t> counts_{0}, totals_;
};

extern template class group_sort<std::uint32_t>;
extern template class group_sort<std::uint64_t>;

}  // namespace facet::tracer
