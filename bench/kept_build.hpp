// A mesh's tree built again and again from corners in device memory, into memory that is kept: what
// a scene costs that changes from picture to picture.
#pragma once

#include <map>
#include <string>

#include "scene/scene.hpp"
#include "tracer/kernels.hpp"
#include "tracer/tree_builder.hpp"

namespace facet::bench {

class kept_build {
 public:
  kept_build(const runtime::queue& q, const scene& s, const tracer::tuning& t,
             tracer::tree_kind kind);

  /// Builds the tree and puts the triangles into its order: until they are ready to be traced, by
  /// the host's clock, in seconds.
  double build();
  /// Milliseconds of the last build by the device's clock, each kernel's sum.
  std::map<std::string, double> kernel_ms() const;
  std::uint64_t bytes() const;  ///< of nodes, as many as there are, and of triangles

 private:
  runtime::queue queue_;
  tracer::packed_scene packed_;
  std::uint32_t count_;
  tracer::tuning tuned_;
  tracer::tree_builder<tracer::texel> builder_;
  runtime::buffer<tracer::texel> corners_, corners_out_;
  runtime::buffer<std::uint32_t> materials_;
  runtime::buffer<tracer::TriangleInfo> infos_;
  tracer::node_tree tree_;
};

}  // namespace facet::bench
