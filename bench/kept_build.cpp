#include "bench/kept_build.hpp"

#include "tracer/stopwatch.hpp"

namespace facet::bench {

using namespace tracer;

kept_build::kept_build(const runtime::queue& q, const scene& s, const tuning& t, tree_kind kind)
    : queue_(q),
      packed_(pack(s, false)),
      count_(packed_.world.triangle_count),
      tuned_(t),
      builder_(q, kernel_sources(), tuned_, kind, {tuned_.leaf_sure, tuned_.leaf_size}, true),
      corners_(packed_.corners.data(), packed_.corners.size()),
      corners_out_(packed_.corners.size()),
      materials_(packed_.triangle_materials.data(), count_),
      infos_(count_) {}

double kept_build::build() {
  const auto start = tracer::clock::now();
  const leaf_triangles sorted{materials_, corners_out_, infos_, 0};
  builder_.build(corners_, count_, tree_, &sorted);
  queue_.wait_and_throw();
  return 1e-3 * milliseconds_since(start);
}

std::map<std::string, double> kept_build::kernel_ms() const {
  std::map<std::string, double> sums;
  for (const step& s : builder_.steps()) sums[s.kernel] += s.done.milliseconds();
  return sums;
}

std::uint64_t kept_build::bytes() const {
  return tree_.node_count * sizeof(Node) + corners_out_.byte_size() + infos_.byte_size();
}

}  // namespace facet::bench
