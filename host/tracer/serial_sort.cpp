#include "tracer/serial_sort.hpp"

#include <algorithm>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr unsigned widest_digit = 11;

unsigned passes_of(unsigned bits) { return (bits + widest_digit - 1) / widest_digit; }

sort_tiles tiles_of(std::uint32_t count, const sort_tuning& t) {
  const std::uint32_t size = std::max(t.tile_least, (count + t.tiles - 1) / t.tiles);
  return {size, (count + size - 1) / size};
}

}  // namespace

/// One pass of a sort. Pass 0 reads keys and values, the others the records that the one before
/// wrote; the last one writes keys and values.
template <class Key>
struct serial_sort<Key>::cut {
  sort_tiles tiles;
  runtime::buffer<BucketPlan>* plan;  ///< nothing is done where buckets are used
  unsigned pass, passes;
  std::uint32_t shift, mask;

  bool is_first() const { return pass == 0; }
  bool is_last() const { return pass + 1 == passes; }
  std::size_t from() const { return (pass + 1) % 2; }
  std::size_t to() const { return pass % 2; }
};

template <class Key>
serial_sort<Key>::serial_sort(runtime::queue q, const runtime::source_tree& kernels,
                              const tuning& t)
    : queue_(q),
      tuning_(t.sort),
      program_(compiled(q, kernels, order_file, t.flags() + key_options<Key>())),
      count_keys_(program_.get_kernel("count_keys")),
      count_records_(program_.get_kernel("count_records")),
      scan_(program_.get_kernel("scan_counts")),
      scatter_keys_(program_.get_kernel("scatter_keys")),
      scatter_records_(program_.get_kernel("scatter_records")),
      scatter_apart_(program_.get_kernel("scatter_apart")),
      take_apart_(program_.get_kernel("take_apart")),
      buckets_(q, kernels, t),
      no_plan_(std::vector<BucketPlan>(1).data(), 1) {
  static_assert(serial_scratch<Key>::digits == 1u << widest_digit);
}

template <class Key>
std::uint64_t serial_sort<Key>::scratch_bytes(std::uint32_t count, const sort_tuning& t) {
  return 2 * std::uint64_t(count) * sizeof(sort_record<Key>) +
         std::uint64_t(t.tiles) * serial_scratch<Key>::digits * sizeof(std::uint32_t) +
         bucket_sort<Key>::scratch_bytes(count, t);
}

template <class Key>
std::vector<step> serial_sort<Key>::sort(const sort_request<Key>& r) {
  std::vector<step> steps;
  if (r.count <= tuning_.few) {
    buckets_.sort_few(r, scratch_, steps);
    return steps;
  }
  const unsigned passes = passes_of(r.bits), width = (r.bits + passes - 1) / passes;
  cut c{};
  c.tiles = tiles_of(r.count, tuning_);
  c.plan = &no_plan_;
  c.passes = passes;
  // Buckets are two walks over memory, and so are two passes.
  if (passes > 2) {
    buckets_.sort(r, c.tiles, scratch_, steps);
    if (buckets_.sorts_any(r.count)) return steps;
    c.plan = &buckets_.plan();
  }
  hold(scratch_.counts, std::size_t(c.tiles.count) * scratch_.digits);
  hold(scratch_.records[0], r.count);
  for (c.pass = 0; c.pass < passes; ++c.pass) {
    c.shift = c.pass * width;
    c.mask = (1u << std::min(width, r.bits - c.shift)) - 1;
    count(r, c, steps);
    scatter(r, c, steps);
  }
  return steps;
}

template <class Key>
void serial_sort<Key>::count(const sort_request<Key>& r, const cut& c, std::vector<step>& steps) {
  steps.push_back({"count", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor counts{scratch_.counts, h, runtime::write_only};
                     const auto launch = [&](const auto& from, const runtime::kernel& kernel) {
                       const runtime::accessor in{from, h, runtime::read_only};
                       const runtime::accessor plan{*c.plan, h, runtime::read_only};
                       h.set_args(in, counts, r.count, c.tiles.size, c.shift, c.mask, plan);
                       h.parallel_for(c.tiles.range(), kernel);
                     };
                     if (c.is_first())
                       launch(r.keys, count_keys_);
                     else
                       launch(scratch_.records[c.from()], count_records_);
                   })});
  steps.push_back({"scan", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor counts{scratch_.counts, h, runtime::read_write};
                     const runtime::accessor plan{*c.plan, h, runtime::read_only};
                     h.set_args(counts, c.tiles.count, plan);
                     h.single_task(scan_);
                   })});
}

template <class Key>
void serial_sort<Key>::scatter(const sort_request<Key>& r, const cut& c, std::vector<step>& steps) {
  steps.push_back(
      {"scatter", queue_.submit([&](runtime::handler& h) {
         const runtime::accessor places{scratch_.counts, h, runtime::read_only};
         const runtime::accessor plan{*c.plan, h, runtime::read_only};
         if (c.is_first()) {
           const std::uint32_t is_first_order = r.is_first_order;
           const runtime::accessor keys{r.keys, h, runtime::read_only};
           const runtime::accessor values{r.values, h, runtime::read_only};
           const runtime::accessor out{scratch_.records[c.to()], h, runtime::write_only};
           h.set_args(keys, values, places, out, r.count, c.tiles.size, c.shift, c.mask,
                      is_first_order, plan);
           h.parallel_for(c.tiles.range(), scatter_keys_);
           return;
         }
         const runtime::accessor in{scratch_.records[c.from()], h, runtime::read_only};
         if (c.is_last()) {
           const runtime::accessor keys{r.keys, h, runtime::write_only};
           const runtime::accessor values{r.values, h, runtime::write_only};
           h.set_args(in, places, keys, values, r.count, c.tiles.size, c.shift, c.mask, plan);
           h.parallel_for(c.tiles.range(), scatter_apart_);
         } else {
           const runtime::accessor out{scratch_.records[c.to()], h, runtime::write_only};
           h.set_args(in, places, out, r.count, c.tiles.size, c.shift, c.mask, plan);
           h.parallel_for(c.tiles.range(), scatter_records_);
         }
       })});
  if (!c.is_first() || !c.is_last()) return;
  steps.push_back({"take_apart", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor in{scratch_.records[c.to()], h, runtime::read_only};
                     const runtime::accessor keys{r.keys, h, runtime::write_only};
                     const runtime::accessor values{r.values, h, runtime::write_only};
                     h.set_args(in, keys, values, r.count, c.tiles.size);
                     h.parallel_for(c.tiles.range(), take_apart_);
                   })});
}

template class serial_sort<std::uint32_t>;
template class serial_sort<std::uint64_t>;

}  // namespace facet::tracer
