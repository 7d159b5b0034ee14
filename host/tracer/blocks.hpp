// Triangles in the wide layout's blocks, made on the device.
#pragma once

#include <cstdint>

#include "runtime/runtime.hpp"
#include "tracer/layout.hpp"
#include "tracer/pack.hpp"
#include "tracer/program_set.hpp"
#include "tracer/tuning.hpp"

namespace facet::tracer {

/// Which triangles a mesh's blocks hold.
struct block_list {
  runtime::buffer<std::uint32_t>
      leaves;                            ///< FACET_LEAF, 1 to 8 places of `order` in a row, a block
  runtime::buffer<std::uint32_t> order;  ///< triangles of the mesh
  std::uint32_t count = 0;               ///< blocks
};

class block_maker {
 public:
  block_maker(runtime::queue q, const runtime::source_tree& kernels, const tuning& t);

  /// Triangle i has corners[3i..3i+2] and materials[i]. Block k of the list is written at
  /// first_block + k: TriangleBlocks, as texels, and infos of the slots. Nothing is waited for.
  void make(const block_list& list, const runtime::buffer<texel>& corners,
            const runtime::buffer<std::uint32_t>& materials, runtime::buffer<texel>& blocks,
            runtime::buffer<TriangleInfo>& infos, std::uint32_t first_block);
  /// The same of three normals a triangle; `to` has three a slot.
  void normals(const block_list& list, const runtime::buffer<texel>& normals,
               runtime::buffer<texel>& to, std::uint32_t first_block);

  void add_programs(program_set& to) const { to.add(program_); }

 private:
  runtime::nd_range<1> range(std::uint32_t blocks) const;

  runtime::queue queue_;
  std::uint32_t run_;  ///< blocks that a work-item makes
  runtime::program program_;
  runtime::kernel make_blocks_, block_normals_;
};

}  // namespace facet::tracer
