#include "tracer/moved_corners.hpp"

#include <algorithm>

#include "tracer/launch.hpp"

namespace facet::tracer {
namespace {

constexpr std::uint32_t room = 1024;  ///< triangles that are listed at most

template <class T>
runtime::buffer<T> uploaded(const std::vector<T>& from) {
  return from.empty() ? runtime::buffer<T>(1) : runtime::buffer<T>(from.data(), from.size());
}

/// A bit a triangle.
std::vector<std::uint32_t> bits_of(const std::vector<bool>& flags) {
  std::vector<std::uint32_t> words((flags.size() + 31) / 32, 0);
  for (std::size_t i = 0; i < flags.size(); ++i)
    words[i / 32] |= std::uint32_t(flags[i]) << (i % 32);
  return words;
}

}  // namespace

mesh_vertices::mesh_vertices(const mesh& m)
    : indices(uploaded(m.indices)),
      normal_indices(uploaded(m.normal_indices)),
      positions(m.positions.size()),
      normals(m.normals.size()) {}

corner_mover::corner_mover(const runtime::queue& q, const runtime::source_tree& kernels,
                           const tuning& t, bool is_wide)
    : queue_(q),
      is_wide_(is_wide),
      group_(t.group),
      run_(t.block_run),
      program_(compiled(q, kernels, "moved_corners.cl", t.flags())),
      move_(program_.get_kernel(is_wide ? "move_blocks" : "move_triangles")),
      move_normals_(program_.get_kernel("move_normals")),
      unsure_(1 + room) {}

void corner_mover::write(const mesh_vertices& v, const device_geometry& g, const mesh_place& at,
                         const std::vector<bool>& shut, const runtime::buffer<texel>& to) {
  const std::uint32_t has_shut = !shut.empty();
  const runtime::buffer<std::uint32_t> bits = has_shut ? uploaded(bits_of(shut)) : none_;
  if (!has_shut)
    queue_.submit([&](runtime::handler& h) {
      h.fill(runtime::accessor{unsure_, h, runtime::write_only}, 0u);
    });
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor indices{v.indices, h, runtime::read_only};
    const runtime::accessor positions{v.positions, h, runtime::read_only};
    const runtime::accessor infos{g.infos, h, runtime::read_only};
    const runtime::accessor points{bits, h, runtime::read_only};
    const runtime::accessor corners{to, h, runtime::read_write};
    const runtime::accessor unsure{unsure_, h, runtime::read_write};
    if (is_wide_) {
      const std::uint32_t blocks = at.slots / FACET_BLOCK;
      h.set_args(indices, positions, infos, points, corners, unsure, room, has_shut,
                 at.first_slot / FACET_BLOCK, blocks, run_);
      h.parallel_for(padded((blocks + run_ - 1) / run_, run_ == 1 ? group_ : 1), move_);
    } else {
      h.set_args(indices, positions, infos, points, corners, unsure, room, has_shut, at.first_slot,
                 at.slots);
      h.parallel_for(padded(at.slots, group_), move_);
    }
  });
}

std::optional<std::vector<std::uint32_t>> corner_mover::unsure() {
  const runtime::host_accessor found{unsure_, runtime::read_only};
  if (found[0] > room) return std::nullopt;
  return std::vector<std::uint32_t>(found.begin() + 1, found.begin() + 1 + found[0]);
}

void corner_mover::write_normals(const mesh_vertices& v, const device_geometry& g,
                                 const mesh_place& at, const runtime::buffer<texel>& to) {
  queue_.submit([&](runtime::handler& h) {
    const runtime::accessor indices{v.normal_indices, h, runtime::read_only};
    const runtime::accessor normals{v.normals, h, runtime::read_only};
    const runtime::accessor infos{g.infos, h, runtime::read_only};
    const runtime::accessor out{to, h, runtime::read_write};
    h.set_args(indices, normals, infos, out, at.first_slot, at.slots);
    h.parallel_for(padded(at.slots, group_), move_normals_);
  });
}

}  // namespace facet::tracer
