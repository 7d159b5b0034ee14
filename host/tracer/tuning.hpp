// Values that only speed depends on, in one place.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "runtime/device.hpp"
#include "tracer/choices.hpp"
#include "tracer/sort_tuning.hpp"

namespace facet::tracer {

struct tuning : choices {
  std::uint32_t block_run = 256;  ///< blocks of the wide layout that a work-item makes
  sort_tuning sort;
  std::uint32_t bounds_group = 1,
                bounds_groups = 64;  ///< of the kernels of cl/morton.cl; a power of 2
  bool serial_trees = true;  ///< a work-item builds a tree alone (cl/serial_tree.cl), not a group
  std::uint32_t list_group = 1, list_each = 1024,
                scan_group = 1;    ///< of cl/subtrees.cl; powers of 2
  bool samples_apart = false;      ///< a work-item for each sample (cl/render_samples.cl)
  std::uint32_t split_group = 64;  ///< that splits a range of the top tree; at least 64
  std::uint32_t refit_group = 1,
                refit_nodes = 1024;  ///< of cl/refit.cl: nodes of a treelet at most
  bool hardware_minmax = false;      ///< cl/device.h
  bool warps = false;                ///< PTX of sm_70 can be written (cl/warp.h)
  bool correctly_rounded = false;    ///< the device can be asked for exact divide and sqrt

  std::string more_flags;  ///< as options::compiler_flags has them

  /// Trees are built by groups, as on GPUs, or by single work-items, as on CPUs.
  void build_in_groups();
  void build_alone();

  bool starts_soon = false;  ///< options::starts_soon

  /// Whether single work-items put primitives in order, too: sort and build as on a CPU.
  bool orders_alone() const { return serial_trees && sort.face == sort_face::serial; }
  /// So many primitives one of them puts in order by itself: to start soon, more than it is as
  /// fast with, since to compile the steps for many takes a second.
  std::uint32_t ordered_at_once() const {
    if (!orders_alone()) return 0;
    return starts_soon ? std::max(sort.few, 1u << 18) : sort.few;
  }

  /// Options for the compiler, each with a space before it.
  std::string flags() const;
};

/// An option for NVIDIA's compiler: a work-item has at most `registers`; 0: as many as it likes.
std::string register_cap(std::uint32_t registers);

/// Defaults by kind of device, measured on a few (bench/, README): for devices never seen.
tuning tuning_for(const runtime::device& d);

}  // namespace facet::tracer
