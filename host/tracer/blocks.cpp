#include "tracer/blocks.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {

block_maker::block_maker(runtime::queue q, const runtime::source_tree& kernels, const tuning& t)
    : queue_(q),
      run_(t.block_run),
      program_(compiled(q, kernels, t.serial_trees ? serial_file : "blocks.cl", t.flags())),
      make_blocks_(program_.get_kernel("make_blocks")),
      block_normals_(program_.get_kernel("block_normals")) {}

runtime::nd_range<1> block_maker::range(std::uint32_t blocks) const {
  return padded((blocks + run_ - 1) / run_, run_ == 1 ? 64 : 1);
}

void block_maker::make(const block_list& list, const runtime::buffer<texel>& corners,
                       const runtime::buffer<std::uint32_t>& materials,
                       runtime::buffer<texel>& blocks, runtime::buffer<TriangleInfo>& infos,
                       std::uint32_t first_block) {
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor leaves{list.leaves, h, runtime::read_only};
    const runtime::accessor order{list.order, h, runtime::read_only};
    const runtime::accessor in{corners, h, runtime::read_only};
    const runtime::accessor in_materials{materials, h, runtime::read_only};
    const runtime::accessor out{blocks, h, runtime::read_write};
    const runtime::accessor out_infos{infos, h, runtime::read_write};
    h.set_args(leaves, order, in, in_materials, out, out_infos, list.count, run_, first_block);
    h.parallel_for(range(list.count), make_blocks_);
  });
}

void block_maker::normals(const block_list& list, const runtime::buffer<texel>& normals,
                          runtime::buffer<texel>& to, std::uint32_t first_block) {
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor leaves{list.leaves, h, runtime::read_only};
    const runtime::accessor order{list.order, h, runtime::read_only};
    const runtime::accessor in{normals, h, runtime::read_only};
    const runtime::accessor out{to, h, runtime::read_write};
    h.set_args(leaves, order, in, out, list.count, run_, first_block);
    h.parallel_for(range(list.count), block_normals_);
  });
}

}  // namespace facet::tracer
