// What stands in where TBB was not found at build time.
#include <stdexcept>

#include "bench/tbb_peer.hpp"

namespace facet::bench {
namespace {

[[noreturn]] void refuse() { throw std::runtime_error("built without TBB (Debian: libtbb-dev)"); }

}  // namespace

std::string tbb_version() { return {}; }
void tbb_sort(std::vector<key_value<std::uint32_t>>&) { refuse(); }
void tbb_sort(std::vector<key_value<std::uint64_t>>&) { refuse(); }

}  // namespace facet::bench
