// CUB's radix sort on the same machine, as a peer of `facet_bench sort`: random keys with 32-bit values,
// temporary storage allocated before. A line of JSON for each number and size of keys. By hand:
//   nvcc -O3 -std=c++17 -arch=sm_90 bench/peers/cub_sort.cu -o cub_sort && ./cub_sort
//   ./cub_sort REPEATS COUNT...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <vector>

#include <cub/device/device_radix_sort.cuh>

namespace {

void check(cudaError_t result, const char* what) {
  if (result == cudaSuccess) return;
  std::fprintf(stderr, "%s: %s\n", what, cudaGetErrorString(result));
  std::exit(1);
}

template <class T>
T* allocate(std::size_t count) {
  void* p = nullptr;
  check(cudaMalloc(&p, count * sizeof(T)), "cudaMalloc");
  return static_cast<T*>(p);
}

/// Whether `keys` ascend, and each value says where its key was.
template <class Key>
bool is_sorted(const std::vector<Key>& input, const std::vector<Key>& keys,
               const std::vector<std::uint32_t>& values) {
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (values[i] >= input.size() || input[values[i]] != keys[i]) return false;
    if (i > 0 && (keys[i] < keys[i - 1] || (keys[i] == keys[i - 1] && values[i] < values[i - 1])))
      return false;
  }
  return true;
}

template <class Key>
void measure(std::uint32_t count, int repeats) {
  std::mt19937_64 random(count + 8 * sizeof(Key));
  std::vector<Key> keys(count);
  std::vector<std::uint32_t> values(count);
  for (std::uint32_t i = 0; i < count; ++i) keys[i] = Key(random() >> (64 - 8 * sizeof(Key))), values[i] = i;
  Key *keys_in = allocate<Key>(count), *keys_out = allocate<Key>(count);
  std::uint32_t *values_in = allocate<std::uint32_t>(count), *values_out = allocate<std::uint32_t>(count);
  const auto sort = [&](void* storage, std::size_t& bytes) {
    check(cub::DeviceRadixSort::SortPairs(storage, bytes, keys_in, keys_out, values_in, values_out,
                                          static_cast<int>(count)),
          "SortPairs");
  };
  std::size_t bytes = 0;
  sort(nullptr, bytes);
  void* storage = allocate<char>(bytes);
  check(cudaMemcpy(keys_in, keys.data(), count * sizeof(Key), cudaMemcpyHostToDevice), "copy");
  check(cudaMemcpy(values_in, values.data(), count * sizeof(std::uint32_t), cudaMemcpyHostToDevice), "copy");

  cudaEvent_t start, end;
  check(cudaEventCreate(&start), "event");
  check(cudaEventCreate(&end), "event");
  std::vector<double> rates;
  for (int i = 0; i <= repeats; ++i) {  // the first warms up
    check(cudaEventRecord(start), "event");
    sort(storage, bytes);
    check(cudaEventRecord(end), "event");
    check(cudaEventSynchronize(end), "sort");
    float ms = 0;
    check(cudaEventElapsedTime(&ms, start, end), "time");
    if (i > 0) rates.push_back(count / (ms * 1e6));
  }
  std::sort(rates.begin(), rates.end());
  std::vector<Key> sorted(count);
  std::vector<std::uint32_t> order(count);
  check(cudaMemcpy(sorted.data(), keys_out, count * sizeof(Key), cudaMemcpyDeviceToHost), "copy");
  check(cudaMemcpy(order.data(), values_out, count * sizeof(std::uint32_t), cudaMemcpyDeviceToHost), "copy");
  if (!is_sorted(keys, sorted, order)) {
    std::fprintf(stderr, "%u keys came back in a wrong order\n", count);
    std::exit(1);
  }
  const std::size_t half = rates.size() / 2;
  const double median = rates.size() % 2 ? rates[half] : (rates[half - 1] + rates[half]) / 2;
  std::printf("{\"peer\": \"CUB %d.%d.%d\", \"count\": %u, \"key_bits\": %zu, \"gkeys_per_s\": %.4f, "
              "\"gkeys_per_s_least\": %.4f, \"gkeys_per_s_most\": %.4f, \"repeats\": %d}\n",
              CUB_MAJOR_VERSION, CUB_MINOR_VERSION, CUB_SUBMINOR_VERSION, count, 8 * sizeof(Key), median,
              rates.front(), rates.back(), repeats);
  for (void* p : {static_cast<void*>(keys_in), static_cast<void*>(keys_out), static_cast<void*>(values_in),
                  static_cast<void*>(values_out), storage})
    check(cudaFree(p), "cudaFree");
  cudaEventDestroy(start);
  cudaEventDestroy(end);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 21;
  std::vector<std::uint32_t> counts{1000, 10000, 100000, 1000000, 10000000, 1u << 24};
  if (argc > 2) counts.clear();
  for (int i = 2; i < argc; ++i) counts.push_back(static_cast<std::uint32_t>(std::atof(argv[i])));
  for (const std::uint32_t count : counts) {
    measure<std::uint32_t>(count, repeats);
    measure<std::uint64_t>(count, repeats);
  }
}
