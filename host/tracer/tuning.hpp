// Values that only speed depends on, in one place.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/device.hpp"
#include "tracer/sort_tuning.hpp"

namespace facet::tracer {

struct tuning {
  std::uint32_t group = 64;        ///< work-items a group of one-dimensional kernels
  std::uint32_t packet_group = 4;  ///< of those whose work-items take packets
  std::uint32_t render_group_width = 8,
                render_group_height = 8;  ///< the render kernel's work-group
  std::uint32_t leaf_sure = 2;    ///< triangles: a subtree of at most so many is a leaf, ...
  std::uint32_t leaf_size = 4;    ///< ... of more than so many not (1 to 16)
  std::uint32_t block_run = 256;  ///< blocks of the wide layout that a work-item makes
  sort_tuning sort;
  std::uint32_t bounds_group = 16,
                bounds_groups = 64;  ///< of the kernels of cl/morton.cl; a power of 2
  bool serial_trees = true;  ///< a work-item builds a tree alone (cl/serial_tree.cl), not a group
  std::uint32_t list_group = 64, list_each = 32,
                scan_group = 1;    ///< of cl/subtrees.cl; powers of 2
  std::uint32_t split_group = 64;  ///< that splits a range of the top tree; at least 64
  std::uint32_t refit_group = 1,
                refit_nodes = 1024;   ///< of cl/refit.cl: nodes of a treelet at most
  bool image_geometry = false;        ///< what --geometry auto means
  bool wide_layout = false;           ///< what layout_kind::automatic means, but for images
  bool packets = false;               ///< what packet_kind::automatic means, if they can be
  bool split_render = false;          ///< what split_kind::automatic means
  bool hardware_minmax = false;       ///< cl/device.h
  bool warps = false;                 ///< PTX of sm_70 can be written (cl/warp.h)
  std::uint32_t trace_registers = 0;  ///< of trace.cl's and render_split.cl's (register_cap)
  bool correctly_rounded = false;     ///< the device can be asked for exact divide and sqrt

  std::string more_flags;  ///< as options::compiler_flags has them

  /// Options for the compiler, each with a space before it.
  std::string flags() const;
};

/// An option for NVIDIA's compiler: a work-item has at most `registers`; 0: as many as it likes.
std::string register_cap(std::uint32_t registers);

/// Measured defaults by kind of device (bench/, README).
tuning tuning_for(const runtime::device& d);

}  // namespace facet::tracer
