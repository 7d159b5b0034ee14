// The ways that growth is measured in, as one: rays in, time and hits out.
#pragma once

#include <memory>
#include <vector>

#include "bench/growth.hpp"
#include "bench/workload.hpp"

namespace facet::bench {

using hits_of = std::vector<tracer::hit>;

/// A way that is being measured on one mesh.
class contender {
 public:
  virtual ~contender() = default;
  /// Milliseconds of one pass, and its hits.
  virtual double trace(const std::vector<ray>& rays, bool any, hits_of& hits) = 0;
  /// What is known of the mesh's place and tree.
  virtual void describe(growth_point& p) = 0;
};

/// Places the mesh and builds what the way needs; the scene must outlive it. Throws
/// runtime::exception for what the device refuses.
std::unique_ptr<contender> make_contender(const runtime::queue& queue, const scene& s, way by,
                                          const growth_settings& settings);

}  // namespace facet::bench
