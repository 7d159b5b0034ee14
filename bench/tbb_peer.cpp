#include "bench/tbb_peer.hpp"

#include <tbb/parallel_sort.h>
#include <tbb/version.h>

namespace facet::bench {

std::string tbb_version() {
  return "TBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
}

void tbb_sort(std::vector<key_value<std::uint32_t>>& pairs) {
  tbb::parallel_sort(pairs.begin(), pairs.end());
}
void tbb_sort(std::vector<key_value<std::uint64_t>>& pairs) {
  tbb::parallel_sort(pairs.begin(), pairs.end());
}

}  // namespace facet::bench
