#include "cli/memory.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>

#include "cli/console.hpp"

namespace facet::cli {

std::uint64_t host_memory() {
  std::uint64_t bytes =
      std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGESIZE));
  rlimit limit{};
  if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
    bytes = std::min<std::uint64_t>(bytes, limit.rlim_cur);
  return bytes;
}

void require_memory(std::uint64_t bytes, const std::string& what) {
  const std::uint64_t most = host_memory();
  if (bytes > most)
    throw memory_error(what + " needs " + bytes_text(double(bytes)) + " of memory, and there are " +
                       bytes_text(double(most)) + "; make it smaller");
}

}  // namespace facet::cli
