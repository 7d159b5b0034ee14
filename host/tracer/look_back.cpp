#include "tracer/look_back.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "tracer/kernels.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t columns = 64;

/// More than a device runs at once: twice the 32 that NVIDIA's multiprocessors hold at most.
std::uint32_t groups_for(const runtime::device& d) {
  return std::clamp(64 * std::uint32_t(d.max_compute_units()), 256u, 32768u);
}

std::uint32_t own_count(std::uint32_t group, std::uint32_t column) {
  return (group * 7 + column * 13) % 31;
}

template <class T>
void fill(runtime::queue& q, const runtime::buffer<T>& b, T value) {
  q.submit([&](runtime::handler& h) {
    h.fill(runtime::accessor{b, h, runtime::write_only}, value);
  });
}

}  // namespace

std::string warp_options(const sort_tuning& t) {
  std::string o = " -DFACET_LOOK_BACK_WINDOW=" + std::to_string(t.window);
  if (t.ranking != sort_ranking::portable) o += " -DFACET_PTX";
  if (t.ranking == sort_ranking::match) o += " -DFACET_SORT_MATCH";
  return o;
}

bool prove_look_back(runtime::queue q, const runtime::source_tree& kernels, const tuning& t,
                     std::uint32_t steps, const std::string& more_options) {
  const runtime::program program =
      compiled(q, kernels, "look_back.cl", t.flags() + warp_options(t.sort) + more_options);
  const runtime::kernel prove = program.get_kernel("prove_look_back");
  const std::uint32_t groups = groups_for(q.get_device());
  runtime::buffer<std::uint32_t> words(groups * columns), sums(groups * columns), counter(1),
      failed(1);
  fill(q, words, 0u);
  fill(q, counter, 0u);
  fill(q, failed, 0u);
  q.submit([&](runtime::handler& h) {
    const runtime::accessor w{words, h, runtime::read_write};
    const runtime::accessor c{counter, h, runtime::read_write};
    const runtime::accessor f{failed, h, runtime::read_write};
    const runtime::accessor s{sums, h, runtime::write_only};
    h.set_args(w, c, f, s, steps);
    h.parallel_for(
        runtime::nd_range<1>(runtime::range<1>(groups * columns), runtime::range<1>(columns)),
        prove);
  });
  if (runtime::host_accessor{failed, runtime::read_only}[0] != 0) return false;
  const runtime::host_accessor found{sums, runtime::read_only};
  for (std::uint32_t c = 0; c < columns; ++c) {
    std::uint32_t sum = 0;
    for (std::uint32_t g = 0; g < groups; ++g) {
      if (found[g * columns + c] != sum) return false;
      sum += own_count(g, c);
    }
  }
  return true;
}

bool has_look_back(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t) {
  static std::mutex mutex;
  static std::map<runtime::native::device, bool> known;
  const std::lock_guard lock(mutex);
  const runtime::device device = q.get_device();
  const auto found = known.find(device.get());
  if (found != known.end()) return found->second;
  // A GPU's step takes about a microsecond. A CPU's takes nanoseconds, and what it waits for may
  // have lost its core for a while.
  const std::uint32_t steps = device.is_gpu() ? 1u << 18 : 1u << 28;
  return known[device.get()] = prove_look_back(q, kernels, t, steps);
}

}  // namespace facet::tracer
