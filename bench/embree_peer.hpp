// Embree 3, as a peer: medium quality, no robust flag, single rays.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/workload.hpp"

namespace facet::bench {

/// "Embree 3.13.5", or empty if the build found none; then no embree_peer can be made.
std::string embree_version();

class embree_peer {
 public:
  /// Throws std::runtime_error without Embree, or with its message.
  embree_peer(const mesh& m, unsigned threads);
  ~embree_peer();

  double build_seconds() const;
  /// The closest hit by rtcIntersect1, written as the reference writes it: instance 0.
  void closest(const std::vector<ray>& rays, std::vector<hit>& hits) const;
  /// By rtcIntersect1, or with `any` by rtcOccluded1 (t, u, v are then undefined), on `threads`
  /// threads that take parts of the rays in turn.
  void trace(const std::vector<ray>& rays, bool any, unsigned threads,
             std::vector<hit>& hits) const;

 private:
  void trace_part(const std::vector<ray>& rays, bool any, std::size_t first, std::size_t last,
                  std::vector<hit>& hits) const;
  struct state;
  std::unique_ptr<state> state_;
};

}  // namespace facet::bench
