// Values that only speed depends on, in one place.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/device.hpp"
#include "tracer/sort_tuning.hpp"

namespace facet::tracer {

struct tuning {
  std::uint32_t group = 64;  ///< work-items a group of one-dimensional kernels
  std::uint32_t render_group_width = 8,
                render_group_height = 8;  ///< the render kernel's work-group
  std::uint32_t leaf_size = 4;            ///< triangles a leaf holds at most, 1 to 16
  std::uint32_t block_run = 256;          ///< blocks of the wide layout that a work-item makes
  sort_tuning sort;
  bool image_geometry = false;     ///< what --geometry auto means
  bool wide_layout = false;        ///< what layout_kind::automatic means, but for images
  bool hardware_minmax = false;    ///< cl/device.h
  bool correctly_rounded = false;  ///< the device can be asked for exact divide and sqrt

  std::string more_flags;  ///< as options::compiler_flags has them

  /// Options for the compiler, each with a space before it.
  std::string flags() const;
};

/// Measured defaults by kind of device (bench/, README).
tuning tuning_for(const runtime::device& d);

}  // namespace facet::tracer
