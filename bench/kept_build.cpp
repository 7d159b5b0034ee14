#include "bench/kept_build.hpp"

#include "tracer/stopwatch.hpp"

namespace facet::bench {

using namespace tracer;

kept_build::kept_build(const runtime::queue& q, const scene& s, const tuning& t)
    : queue_(q),
      packed_(pack(s, false)),
      count_(packed_.world.triangle_count),
      tuned_(t),
      builder_(q, kernel_sources(), tuned_, {tuned_.leaf_sure, tuned_.leaf_size}),
      gather_(q, kernel_sources(), tuned_),
      corners_(packed_.corners.data(), packed_.corners.size()),
      corners_out_(packed_.corners.size()),
      materials_(packed_.triangle_materials.data(), count_),
      infos_(count_) {}

double kept_build::build() {
  const auto start = tracer::clock::now();
  builder_.build(corners_, count_, tree_);
  gathered_ = gather_.triangles(tree_.order, corners_, materials_, corners_out_, infos_, count_, 0);
  queue_.wait_and_throw();
  return 1e-3 * milliseconds_since(start);
}

std::map<std::string, double> kept_build::kernel_ms() const {
  std::map<std::string, double> sums;
  const auto add = [&](const std::string& name, const runtime::event& e) {
    sums[name] += e.milliseconds();
  };
  for (const step& s : builder_.steps()) add(s.kernel, s.done);
  add("gather_triangles", gathered_);
  return sums;
}

std::uint64_t kept_build::bytes() const {
  return tree_.node_count * sizeof(Node) + corners_out_.byte_size() + infos_.byte_size();
}

}  // namespace facet::bench
