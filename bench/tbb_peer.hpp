// TBB, as a peer: parallel_sort of pairs by their keys, on all of the machine's threads.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace facet::bench {

template <class Key>
struct key_value {
  Key key;
  std::uint32_t value;
  friend bool operator<(const key_value& a, const key_value& b) { return a.key < b.key; }
};

/// "TBB 2021.8", or empty if the build found none; then tbb_sort throws std::runtime_error.
std::string tbb_version();

void tbb_sort(std::vector<key_value<std::uint32_t>>& pairs);
void tbb_sort(std::vector<key_value<std::uint64_t>>& pairs);

}  // namespace facet::bench
