// The radix sort by single work-items, a large tile each: cl/radix_serial.cl.
#pragma once

#include <array>

#include "tracer/sort_way.hpp"

namespace facet::tracer {

template <class Key>
class serial_sort : public sort_way<Key> {
 public:
  serial_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  std::vector<step> sort(const sort_request<Key>& r) override;
  double compile_ms() const override { return program_.build_ms(); }

  static std::uint64_t scratch_bytes(std::uint32_t count, const sort_tuning& t);
  /// Keys that a work-item takes of `count`.
  static std::uint32_t tile_size(std::uint32_t count, const sort_tuning& t);

 private:
  struct record {
    Key key;
    std::uint32_t value;
  };
  struct cut;
  void count(const sort_request<Key>& r, const cut& c, std::vector<step>& steps);
  void scatter(const sort_request<Key>& r, const cut& c, std::vector<step>& steps);

  runtime::queue queue_;
  sort_tuning tuning_;
  runtime::program program_;
  runtime::kernel count_keys_, count_records_, scan_, scatter_keys_, scatter_records_,
      scatter_apart_, take_apart_;
  runtime::buffer<std::uint32_t> counts_{0};
  std::array<runtime::buffer<record>, 2> records_{runtime::buffer<record>(0),
                                                  runtime::buffer<record>(0)};
};

extern template class serial_sort<std::uint32_t>;
extern template class serial_sort<std::uint64_t>;

}  // namespace facet::tracer
