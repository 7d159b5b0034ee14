#include "tracer/group_sort.hpp"

#include <algorithm>
#include <utility>

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"
#include "tracer/look_back.hpp"

namespace facet::tracer {
namespace {

constexpr unsigned digit_bits = 8;
constexpr std::uint32_t digits = 1u << digit_bits;
constexpr std::uint32_t adders = 256;  // a group, and chunks at most (cl/radix_counts.cl)
constexpr std::uint32_t chunk_least = 2048;
constexpr std::uint32_t any_count = sort_tuning::any_count;
constexpr std::uint32_t state_stride = 32;  // STATE_STRIDE in cl/radix_sort.cl

template <class Key>
std::uint32_t group_of(const sort_tuning& t) {
  return sizeof(Key) == 4 ? t.group_32 : t.group_64;
}

template <class Key>
std::uint32_t items_of(const sort_tuning& t) {
  return sizeof(Key) == 4 ? t.items_32 : t.items_64;
}

template <class Key>
std::string options_of(const tuning& t, bool looks_back, std::uint32_t whole_most) {
  std::string o = t.flags() + warp_options(t.sort);
  o += sizeof(Key) == 4 ? " -DKEY=uint" : " -DKEY=ulong";
  o += " -DGROUP=" + std::to_string(group_of<Key>(t.sort));
  o += " -DITEMS=" + std::to_string(items_of<Key>(t.sort));
  o += " -DCOPIES=" + std::to_string(t.sort.histogram_copies);
  if (t.sort.values_beside) o += " -DFACET_SORT_BESIDE";
  if (looks_back) o += " -DFACET_LOOK_BACK";
  if (whole_most > 0) o += " -DFACET_ONE_LAUNCH";
  if (whole_most < any_count) o += " -DFACET_MANY_LAUNCHES";
  return o + register_cap(t.sort.registers);
}

/// Words of local memory that `histogram` needs (HISTOGRAM_WORDS in cl/radix_histogram.h).
template <class Key>
std::uint32_t histogram_words(const sort_tuning& t) {
  return sizeof(Key) * digits * t.histogram_copies;
}

/// Words of local memory that `scatter` needs (LOCAL_WORDS in cl/radix_tile.h).
template <class Key>
std::uint32_t local_words(const sort_tuning& t) {
  const std::uint32_t group = group_of<Key>(t), tile = group * items_of<Key>(t);
  const std::uint32_t key_words = sizeof(Key) / sizeof(std::uint32_t);
  const bool has_warps = t.ranking != sort_ranking::portable;
  const std::uint32_t ranking = has_warps ? group / 32 * digits : std::max(16 * group, tile);
  const std::uint32_t pool = std::max(tile * (key_words + t.values_beside), ranking);
  return pool + digits + 2 * (has_warps ? group / 32 : group);
}

bool looks_back(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t) {
  if (t.sort.look_back == look_back_use::if_proven) return has_look_back(q, kernels, t);
  return t.sort.look_back == look_back_use::always;
}

/// Keys that a sort in one launch has at most. Its groups read what others wrote meanwhile:
/// OpenCL's fences do not order that, but PTX's do, and those of CPUs.
template <class Key>
std::uint32_t whole_most(const runtime::device& d, const sort_tuning& t, bool looks_back) {
  if (!looks_back || (d.is_gpu() && t.ranking == sort_ranking::portable)) return 0;
  return sizeof(Key) == 4 ? t.whole_most_32 : t.whole_most_64;
}

std::uint32_t parts_of(std::uint32_t count, std::uint32_t group, const sort_tuning& t) {
  return std::min((count + group - 1) / group, t.histogram_groups);
}

std::uint32_t mask_of(unsigned bits, unsigned shift) {
  return (1u << std::min(digit_bits, bits - shift)) - 1;
}

}  // namespace

template <class Key>
group_sort<Key>::group_sort(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      tuning_(t.sort),
      looks_back_(looks_back(q, kernels, t)),
      whole_most_(whole_most<Key>(q.get_device(), t.sort, looks_back_)),
      program_(compiled(q, kernels, "radix_sort.cl", options_of<Key>(t, looks_back_, whole_most_))),
      bins_(sizeof(Key) * digits),
      counters_(sizeof(Key)),
      state_(state_stride * (sizeof(Key) + 2)),
      totals_(adders) {
  if (whole_most_ > 0) whole_ = program_.get_kernel("sort_whole");
  if (whole_most_ == any_count) return;
  scatter_ = program_.get_kernel("scatter");
  if (looks_back_) {
    histogram_ = program_.get_kernel("histogram");
    return;
  }
  counting_ = compiled(q, kernels, "radix_counts.cl", options_of<Key>(t, false, 0));
  count_ = counting_->get_kernel("count_digits");
  sum_ = counting_->get_kernel("sum_chunks");
  scan_ = counting_->get_kernel("scan_chunks");
}

template <class Key>
void group_sort<Key>::add_programs(program_set& to) const {
  to.add(program_);
  if (counting_) to.add(*counting_);
}

template <class Key>
std::uint32_t group_sort<Key>::tile_size(const sort_tuning& t) {
  return group_of<Key>(t) * items_of<Key>(t);
}

template <class Key>
std::uint64_t group_sort<Key>::scratch_bytes(std::uint32_t count, const sort_tuning& t) {
  const std::uint64_t tiles = (count + std::uint64_t(tile_size(t)) - 1) / tile_size(t);
  const bool may_look_back = t.look_back != look_back_use::never;
  const std::uint64_t words = (may_look_back ? 2 : 1) * tiles * digits +
                              sizeof(Key) * (digits + 1) + state_stride * (sizeof(Key) + 2) +
                              adders;
  return count * (sizeof(Key) + sizeof(std::uint32_t)) + words * sizeof(std::uint32_t);
}

template <class Key>
std::vector<step> group_sort<Key>::sort(const sort_request<Key>& r) {
  const std::uint32_t tile = tile_size(tuning_), tiles = (r.count + tile - 1) / tile;
  hold(keys_, r.count);
  hold(values_, r.count);
  std::vector<step> steps;
  if (r.count <= whole_most_)
    sort_in_one_launch(r, tiles, steps);
  else if (looks_back_)
    sort_looking_back(r, tiles, steps);
  else
    sort_counting(r, tiles, steps);
  return steps;
}

template <class Key>
void group_sort<Key>::prepare_words(std::uint32_t tiles, std::vector<step>& steps) {
  for (auto& words : words_) hold(words, std::size_t(tiles) * digits);
  if (std::exchange(is_clean_, false)) return;
  for (auto* cleared : {&bins_, &state_})
    steps.push_back({"fill", queue_.submit([&](runtime::handler& h) {
                       h.fill(runtime::accessor{*cleared, h, runtime::write_only}, 0u);
                     })});
}

template <class Key>
void group_sort<Key>::sort_in_one_launch(const sort_request<Key>& r, std::uint32_t tiles,
                                         std::vector<step>& steps) {
  prepare_words(tiles, steps);
  const std::uint32_t group = group_of<Key>(tuning_), parts = parts_of(r.count, group, tuning_);
  const std::uint32_t passes = (r.bits + digit_bits - 1) / digit_bits;
  const std::uint32_t is_first_order = r.is_first_order;
  steps.push_back({"sort_whole", queue_.submit([&](runtime::handler& h) {
                     const runtime::accessor keys{r.keys, h, runtime::read_write};
                     const runtime::accessor values{r.values, h, runtime::read_write};
                     const runtime::accessor other_keys{keys_, h, runtime::read_write};
                     const runtime::accessor other_values{values_, h, runtime::read_write};
                     const runtime::accessor bins{bins_, h, runtime::read_write};
                     const runtime::accessor words{words_[0], h, runtime::read_write};
                     const runtime::accessor next{words_[1], h, runtime::read_write};
                     const runtime::accessor state{state_, h, runtime::read_write};
                     const runtime::local_accessor<std::uint32_t> local(
                         std::max(local_words<Key>(tuning_), histogram_words<Key>(tuning_)), h);
                     h.set_args(keys, values, other_keys, other_values, bins, words, next, state,
                                r.count, r.bits, is_first_order, parts, local);
                     h.parallel_for(in_groups(parts + std::size_t(passes) * tiles, group), *whole_);
                   })});
  if (passes % 2 != 0) {
    std::swap(r.keys, keys_);
    std::swap(r.values, values_);
  }
  is_clean_ = true;
}

template <class Key>
void group_sort<Key>::sort_looking_back(const sort_request<Key>& r, std::uint32_t tiles,
                                        std::vector<step>& steps) {
  prepare_words(tiles, steps);
  const std::uint32_t group = group_of<Key>(tuning_);
  steps.push_back(
      {"histogram", queue_.submit([&](runtime::handler& h) {
         const runtime::accessor keys{r.keys, h, runtime::read_only};
         const runtime::accessor bins{bins_, h, runtime::read_write};
         const runtime::accessor words{words_[0], h, runtime::read_write};
         const runtime::accessor counters{counters_, h, runtime::read_write};
         const runtime::local_accessor<std::uint32_t> local(histogram_words<Key>(tuning_), h);
         h.set_args(keys, bins, words, counters, r.count, r.bits, local);
         h.parallel_for(in_groups(parts_of(r.count, group, tuning_), group), *histogram_);
       })});
  for (unsigned shift = 0; shift < r.bits; shift += digit_bits) {
    const unsigned pass = shift / digit_bits;
    const std::uint32_t is_first_order = r.is_first_order && pass == 0;
    steps.push_back({"scatter", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor keys{r.keys, h, runtime::read_only};
                       const runtime::accessor values{r.values, h, runtime::read_only};
                       const runtime::accessor keys_out{keys_, h, runtime::write_only};
                       const runtime::accessor values_out{values_, h, runtime::write_only};
                       const runtime::accessor bins{bins_, h, runtime::read_write};
                       const runtime::accessor words{words_[pass % 2], h, runtime::read_write};
                       const runtime::accessor next{words_[1 - pass % 2], h, runtime::write_only};
                       const runtime::accessor counters{counters_, h, runtime::read_write};
                       h.set_args(
                           keys, values, keys_out, values_out, bins, words, next, counters, r.count,
                           shift, mask_of(r.bits, shift), is_first_order,
                           runtime::local_accessor<std::uint32_t>(local_words<Key>(tuning_), h));
                       h.parallel_for(in_groups(tiles, group), *scatter_);
                     })});
    std::swap(r.keys, keys_);
    std::swap(r.values, values_);
  }
  is_clean_ = true;
}

template <class Key>
void group_sort<Key>::sort_counting(const sort_request<Key>& r, std::uint32_t tiles,
                                    std::vector<step>& steps) {
  const std::uint32_t length = tiles * digits;
  hold(counts_, length);
  const std::uint32_t chunk = std::max(chunk_least, (length + adders - 1) / adders);
  const std::uint32_t chunks = (length + chunk - 1) / chunk;
  for (unsigned shift = 0; shift < r.bits; shift += digit_bits) {
    const std::uint32_t mask = mask_of(r.bits, shift);
    const std::uint32_t is_first_order = r.is_first_order && shift == 0;
    steps.push_back({"count_digits", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor keys{r.keys, h, runtime::read_only};
                       const runtime::accessor counts{counts_, h, runtime::write_only};
                       h.set_args(keys, counts, r.count, shift, mask);
                       h.parallel_for(in_groups(tiles, group_of<Key>(tuning_)), *count_);
                     })});
    steps.push_back({"sum_chunks", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor counts{counts_, h, runtime::read_only};
                       const runtime::accessor totals{totals_, h, runtime::write_only};
                       h.set_args(counts, totals, length, chunk);
                       h.parallel_for(in_groups(chunks, adders), *sum_);
                     })});
    steps.push_back({"scan_chunks", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor counts{counts_, h, runtime::read_write};
                       const runtime::accessor totals{totals_, h, runtime::read_only};
                       h.set_args(counts, totals, length, chunk);
                       h.parallel_for(in_groups(chunks, adders), *scan_);
                     })});
    steps.push_back({"scatter", queue_.submit([&](runtime::handler& h) {
                       const runtime::accessor keys{r.keys, h, runtime::read_only};
                       const runtime::accessor values{r.values, h, runtime::read_only};
                       const runtime::accessor keys_out{keys_, h, runtime::write_only};
                       const runtime::accessor values_out{values_, h, runtime::write_only};
                       const runtime::accessor places{counts_, h, runtime::read_only};
                       h.set_args(
                           keys, values, keys_out, values_out, places, r.count, shift, mask,
                           is_first_order,
                           runtime::local_accessor<std::uint32_t>(local_words<Key>(tuning_), h));
                       h.parallel_for(in_groups(tiles, group_of<Key>(tuning_)), *scatter_);
                     })});
    std::swap(r.keys, keys_);
    std::swap(r.values, values_);
  }
}

template class group_sort<std::uint32_t>;
template class group_sort<std::uint64_t>;

}  // namespace facet::tracer
