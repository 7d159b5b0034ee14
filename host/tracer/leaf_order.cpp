#include "tracer/leaf_order.hpp"

#include "tracer/kernels.hpp"
#include "tracer/launch.hpp"

namespace facet::tracer {

leaf_order::leaf_order(const runtime::queue& q, const runtime::source_tree& kernels,
                       const tuning& t)
    : queue_(q),
      group_(t.group),
      program_(compiled(q, kernels, "leaf_order.cl", t.flags())),
      triangles_(program_.get_kernel("gather_triangles")),
      normals_(program_.get_kernel("gather_normals")) {}

runtime::event leaf_order::triangles(runtime::buffer<std::uint32_t>& order,
                                     runtime::buffer<texel>& corners, std::uint32_t count,
                                     const leaf_triangles& to) {
  return queue_.submit([&](runtime::handler& h) {
    const runtime::accessor from{order, h, runtime::read_only};
    const runtime::accessor in{corners, h, runtime::read_only};
    const runtime::accessor materials{to.materials, h, runtime::read_only};
    const runtime::accessor out{to.corners, h, runtime::read_write};
    const runtime::accessor infos{to.infos, h, runtime::read_write};
    h.set_args(from, in, materials, out, infos, count, to.slot);
    h.parallel_for(padded(count, group_), triangles_);
  });
}

void leaf_order::normals(runtime::buffer<std::uint32_t>& order, runtime::buffer<texel>& normals,
                         runtime::buffer<texel>& normals_out, std::uint32_t count,
                         std::uint32_t slot) {
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor from{order, h, runtime::read_only};
    const runtime::accessor in{normals, h, runtime::read_only};
    const runtime::accessor out{normals_out, h, runtime::read_write};
    h.set_args(from, in, out, count, slot);
    h.parallel_for(padded(count, group_), normals_);
  });
}

}  // namespace facet::tracer
