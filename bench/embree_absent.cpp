// What stands in where Embree was not found at build time.
#include <stdexcept>

#include "bench/embree_peer.hpp"

namespace facet::bench {

static const char* const absent = "built without Embree (Debian: libembree-dev)";

struct embree_peer::state {};
struct embree_builder::state {};

std::string embree_version() { return {}; }
embree_peer::embree_peer(const mesh&, unsigned, bool) { throw std::runtime_error(absent); }
embree_peer::~embree_peer() = default;
double embree_peer::build_seconds() const { return 0; }
void embree_peer::closest(const std::vector<ray>&, std::vector<hit>&) const {}
void embree_peer::trace(const std::vector<ray>&, bool, unsigned, std::vector<hit>&,
                        embree_calls) const {}

embree_builder::embree_builder(const mesh&, unsigned) { throw std::runtime_error(absent); }
embree_builder::~embree_builder() = default;
double embree_builder::build(embree_quality) { return 0; }

}  // namespace facet::bench
