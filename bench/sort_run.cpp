#include "bench/sort_run.hpp"

#include <algorithm>
#include <random>
#include <stdexcept>

#include "bench/measure.hpp"
#include "bench/tbb_peer.hpp"
#include "tracer/kernels.hpp"
#include "tracer/radix_sort.hpp"

namespace facet::bench {
namespace {

using profiling = runtime::info::event_profiling;

template <class Key>
std::vector<key_value<Key>> random_pairs(std::uint32_t count, unsigned bits) {
  std::mt19937_64 random(count + bits);
  std::vector<key_value<Key>> pairs(count);
  for (std::uint32_t i = 0; i < count; ++i) pairs[i] = {Key(random() >> (64 - bits)), i};
  return pairs;
}

void add_device_times(const std::vector<tracer::step>& steps, sort_times& times) {
  std::uint64_t start = ~std::uint64_t(0), end = 0;
  std::map<std::string, double> here;
  for (const tracer::step& s : steps) {
    start = std::min(start, s.done.get_profiling_info<profiling::command_start>());
    end = std::max(end, s.done.get_profiling_info<profiling::command_end>());
    here[s.kernel] += s.done.milliseconds();
  }
  times.device.push_back(double(end - start) * 1e-9);
  for (const auto& [kernel, ms] : here) {
    const auto found = times.steps.try_emplace(kernel, ms).first;
    found->second = std::min(found->second, ms);
  }
}

}  // namespace

template <class Key>
sort_times measure_sort(runtime::queue q, const sort_plan& plan) {
  const std::uint32_t n = plan.count;
  const std::vector<key_value<Key>> input = random_pairs<Key>(n, plan.bits);
  std::vector<Key> keys(n);
  std::vector<std::uint32_t> values(n);
  for (std::uint32_t i = 0; i < n; ++i) keys[i] = input[i].key, values[i] = input[i].value;

  sort_times times;
  tracer::radix_sort<Key> sorter(q, tracer::kernel_sources(), plan.tuned);
  tracer::program_set programs;
  sorter.add_programs(programs);
  times.compile_ms = programs.build_ms();
  // What is sorted is copied on the device, where a builder's kernels or a peer's sort before leave
  // it: after a copy from the host a GPU begins at rest.
  runtime::buffer<Key> first_keys(keys.data(), n), device_keys(n);
  runtime::buffer<std::uint32_t> first_values(values.data(), n), device_values(n);
  std::vector<key_value<Key>> pairs;
  for (int i = 0; i <= plan.repeats; ++i) {
    q.submit([&](runtime::handler& h) {
      h.copy(runtime::accessor{first_keys, h, runtime::read_only},
             runtime::accessor{device_keys, h, runtime::write_only});
    });
    q.submit([&](runtime::handler& h) {
      h.copy(runtime::accessor{first_values, h, runtime::read_only},
             runtime::accessor{device_values, h, runtime::write_only});
    });
    q.wait_and_throw();
    std::vector<tracer::step> steps;
    const double wall = seconds([&] {
      steps = plan.is_order ? sorter.sort_order(device_keys, device_values, n, plan.bits)
                            : sorter.sort(device_keys, device_values, n, plan.bits);
      q.wait_and_throw();
    });
    if (i > 0) {
      times.wall.push_back(wall);
      add_device_times(steps, times);
    }
    const auto peer = [&](std::vector<double>& to, auto sort) {
      pairs = input;
      const double s = seconds([&] { sort(pairs); });
      if (i > 0) to.push_back(s);
    };
    if (plan.has_tbb) peer(times.tbb, [](auto& p) { tbb_sort(p); });
    if (plan.has_std) peer(times.standard, [](auto& p) { std::sort(p.begin(), p.end()); });
  }

  pairs = input;
  std::stable_sort(pairs.begin(), pairs.end());
  const runtime::host_accessor sorted_keys{device_keys, runtime::read_only};
  const runtime::host_accessor sorted_values{device_values, runtime::read_only};
  std::size_t wrong = 0;
  for (std::uint32_t i = 0; i < n; ++i)
    wrong += sorted_keys[i] != pairs[i].key || sorted_values[i] != pairs[i].value;
  if (wrong > 0)
    throw std::runtime_error(std::to_string(wrong) + " of " + std::to_string(n) +
                             " keys or values are not where std::stable_sort has them");
  return times;
}

template sort_times measure_sort<std::uint32_t>(runtime::queue, const sort_plan&);
template sort_times measure_sort<std::uint64_t>(runtime::queue, const sort_plan&);

}  // namespace facet::bench
