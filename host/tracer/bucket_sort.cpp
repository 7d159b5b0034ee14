#include "tracer/bucket_sort.hpp"

#include <algorithm>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

/// Records that a work-item has twice, so that a bucket goes from one to the other.
std::uint32_t room_of(std::uint32_t count, const sort_tuning& t) {
  return std::min(t.bucket_room, count);
}

/// Of at least 2 buckets, and of at most as many as a tile is counted by.
std::uint32_t bucket_bits(std::uint32_t count, const sort_tuning& t) {
  std::uint32_t bits = 1;
  while ((2u << bits) <= serial_scratch<std::uint32_t>::digits && count >> bits > t.bucket_mean)
    ++bits;
  return bits;
}

}  // namespace

template <class Key>
bucket_sort<Key>::bucket_sort(runtime::queue q, const runtime::source_tree& kernels,
                              const tuning& t)
    : queue_(q),
      tuning_(t.sort),
      program_(compiled(q, kernels, order_file, t.flags() + key_options<Key>())),
      choose_(program_.get_kernel("plan_buckets")),
      count_(program_.get_kernel("count_buckets")),
      scan_(program_.get_kernel("scan_buckets")),
      scatter_(program_.get_kernel("scatter_buckets")),
      sort_(program_.get_kernel("sort_buckets")),
      sort_few_(program_.get_kernel("sort_few")) {}

template <class Key>
std::uint64_t bucket_sort<Key>::scratch_bytes(std::uint32_t count, const sort_tuning& t) {
  return 2 * std::uint64_t(t.tiles) * room_of(count, t) * sizeof(sort_record<Key>) +
         sizeof(BucketPlan);
}

template <class Key>
void bucket_sort<Key>::sort_few(const sort_request<Key>& r, serial_scratch<Key>& in,
                                std::vector<step>& steps) {
  for (auto& records : in.records) hold(records, r.count);
  steps.push_back({"sort_few", queue_.submit([&](runtime::handler& h) {
                     const std::uint32_t is_first_order = r.is_first_order;
                     const runtime::accessor keys{r.keys, h, runtime::read_write};
                     const runtime::accessor values{r.values, h, runtime::read_write};
                     const runtime::accessor records{in.records[0], h, runtime::write_only};
                     const runtime::accessor others{in.records[1], h, runtime::write_only};
                     h.set_args(keys, values, records, others, r.count, r.bits, is_first_order);
                     h.single_task(sort_few_);
                   })});
}

template <class Key>
void bucket_sort<Key>::sort(const sort_request<Key>& r, sort_tiles tiles, serial_scratch<Key>& in,
                            std::vector<step>& steps) {
  hold(in.counts, std::size_t(tiles.count) * in.digits);
  for (auto& records : in.records) hold(records, r.count);
  hold(cached_, 2 * std::size_t(tiles.count) * room_of(r.count, tuning_));
  choose(r, steps);
  scatter(r, tiles, in, steps);
  sort_each(r, tiles, in, steps);
}

template <class Key>
void bucket_sort<Key>::choose(const sort_request<Key>& r, std::vector<step>& steps) {
  steps.push_back({"plan", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor keys{r.keys, h, runtime::read_only};
                     const runtime::accessor plan{plan_, h, runtime::write_only};
                     h.set_args(keys, plan, r.count, r.bits, bucket_bits(r.count, tuning_),
                                tuning_.bucket_most);
                     h.single_task(choose_);
                   })});
}

template <class Key>
void bucket_sort<Key>::scatter(const sort_request<Key>& r, sort_tiles tiles,
                               serial_scratch<Key>& in, std::vector<step>& steps) {
  steps.push_back({"count", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor keys{r.keys, h, runtime::read_only};
                     const runtime::accessor counts{in.counts, h, runtime::write_only};
                     const runtime::accessor plan{plan_, h, runtime::read_only};
                     h.set_args(keys, counts, r.count, tiles.size, r.bits, plan);
                     h.parallel_for(tiles.range(), count_);
                   })});
  steps.push_back({"scan", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor counts{in.counts, h, runtime::read_write};
                     const runtime::accessor plan{plan_, h, runtime::read_only};
                     h.set_args(counts, tiles.count, plan);
                     h.single_task(scan_);
                   })});
  steps.push_back({"scatter", queue_.submit([&](runtime::handler& h) {
                     const std::uint32_t is_first_order = r.is_first_order;
                     const runtime::accessor keys{r.keys, h, runtime::read_only};
                     const runtime::accessor values{r.values, h, runtime::read_only};
                     const runtime::accessor places{in.counts, h, runtime::read_only};
                     const runtime::accessor out{in.records[0], h, runtime::write_only};
                     const runtime::accessor plan{plan_, h, runtime::read_only};
                     h.set_args(keys, values, places, out, r.count, tiles.size, r.bits,
                                is_first_order, plan);
                     h.parallel_for(tiles.range(), scatter_);
                   })});
}

template <class Key>
void bucket_sort<Key>::sort_each(const sort_request<Key>& r, sort_tiles tiles,
                                 serial_scratch<Key>& in, std::vector<step>& steps) {
  steps.push_back({"sort_buckets", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor records{in.records[0], h, runtime::read_write};
                     const runtime::accessor others{in.records[1], h, runtime::write_only};
                     const runtime::accessor cached{cached_, h, runtime::write_only};
                     const runtime::accessor begins{in.counts, h, runtime::read_only};
                     const runtime::accessor keys{r.keys, h, runtime::write_only};
                     const runtime::accessor values{r.values, h, runtime::write_only};
                     const runtime::accessor plan{plan_, h, runtime::read_write};
                     h.set_args(records, others, cached, begins, keys, values, r.count, r.bits,
                                room_of(r.count, tuning_), plan);
                     h.parallel_for(tiles.range(), sort_);
                   })});
}

template class bucket_sort<std::uint32_t>;
template class bucket_sort<std::uint64_t>;

}  // namespace facet::tracer
