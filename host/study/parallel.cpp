#include "study/parallel.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace facet::study {

void in_parallel(unsigned thread_count, std::uint64_t count,
                 const std::function<void(std::uint64_t, std::uint64_t)>& body) {
  const std::uint64_t parts =
      std::min<std::uint64_t>(std::max(1u, thread_count), (count + 63) / 64);
  if (parts <= 1) return body(0, count);
  std::exception_ptr failure;
  std::mutex mutex;
  std::vector<std::thread> threads;
  for (std::uint64_t p = 0; p < parts; ++p)
    threads.emplace_back([&, p] {
      try {
        body(count * p / parts, count * (p + 1) / parts);
      } catch (...) {
        const std::lock_guard lock(mutex);
        failure = std::current_exception();
      }
    });
  for (std::thread& t : threads) t.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace facet::study
