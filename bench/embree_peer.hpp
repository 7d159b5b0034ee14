// Embree 3, as a peer: trees of medium quality where they are traced.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/workload.hpp"

namespace facet::bench {

/// "Embree 3.13.5", or empty if the build found none; then no embree_peer can be made.
std::string embree_version();

/// A ray a call, or sixteen that follow one another, told that they are coherent.
enum class embree_calls { single, packets };

class embree_peer {
 public:
  /// `robust` asks for its tests that leak less. Throws std::runtime_error without Embree, or with
  /// its message.
  embree_peer(const mesh& m, unsigned threads, bool robust = false);
  ~embree_peer();

  double build_seconds() const;
  /// The closest hit by rtcIntersect1, written as the reference writes it: instance 0.
  void closest(const std::vector<ray>& rays, std::vector<hit>& hits) const;
  /// By rtcIntersect1 or rtcIntersect16, or with `any` by rtcOccluded1 or rtcOccluded16 (t, u, v
  /// are then undefined), on `threads` threads that take parts of the rays in turn.
  void trace(const std::vector<ray>& rays, bool any, unsigned threads, std::vector<hit>& hits,
             embree_calls calls = embree_calls::single) const;

 private:
  void trace_part(const std::vector<ray>& rays, bool any, std::size_t first, std::size_t last,
                  std::vector<hit>& hits) const;
  void trace_packets(const std::vector<ray>& rays, bool any, std::size_t first, std::size_t last,
                     std::vector<hit>& hits) const;
  struct state;
  std::unique_ptr<state> state_;
};

/// `low` asks for it of scene and geometry both, so that the tree is of Morton codes.
enum class embree_quality { low, medium };

/// Builds a mesh's tree, again and again, on one device with its threads.
class embree_builder {
 public:
  /// Keeps a reference. Throws std::runtime_error without Embree, or with its message.
  embree_builder(const mesh& m, unsigned threads);
  ~embree_builder();

  /// Seconds from a mesh in Embree's own buffers until its scene is ready to be traced.
  double build(embree_quality q);

 private:
  struct state;
  std::unique_ptr<state> state_;
};

}  // namespace facet::bench
