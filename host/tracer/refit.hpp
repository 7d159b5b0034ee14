// Boxes of a mesh's tree made anew on the device when its triangles have moved (cl/refit.cl).
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/runtime.hpp"
#include "tracer/kernels.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tree.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// A refit_order on the device.
struct refit_plan {
  runtime::buffer<std::uint32_t> nodes{1}, starts{1};
  std::vector<std::uint32_t> phases;  ///< each one's first treelet, and the end

  std::uint64_t bytes() const {
    return phases.size() < 2 ? 0 : nodes.byte_size() + starts.byte_size();
  }
};

class refitter {
 public:
  /// The tuning must live as long.
  refitter(const runtime::queue& q, const runtime::source_tree& kernels, const tuning& t,
           bool is_wide);

  /// Reads the tree's shape back: once a mesh.
  refit_plan plan(const device_geometry& g, const mesh_place& at);

  /// Each box of the mesh's tree becomes that of the triangles below it. corners: as
  /// device_geometry has them. Nothing is waited for.
  void refit(const refit_plan& p, device_geometry& g, const mesh_place& at,
             const runtime::buffer<texel>& corners);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::queue queue_;
  bool is_wide_;
  std::uint32_t group_, most_;
  runtime::program program_;
  runtime::kernel list_children_, refit_treelets_;
};

}  // namespace facet::tracer
