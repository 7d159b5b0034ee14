// What only measuring tells on a device: how rays are led through the scene, and in what
// work-groups. No bit of a hit or of a picture depends on it.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/device.hpp"

namespace facet::tracer {

struct choices {
  bool wide_layout = false;        ///< what layout_kind::automatic means, but for images
  bool image_geometry = false;     ///< what geometry_kind::automatic means, but in the wide layout
  bool packets = false;            ///< what packet_kind::automatic means, if they can be
  std::uint32_t packet_group = 4;  ///< work-items a group of kernels whose work-items take packets
  std::uint32_t group = 64;        ///< of the other one-dimensional kernels
  std::uint32_t render_group_width = 8,
                render_group_height = 8;  ///< the render kernel's work-group
  std::uint32_t trace_registers = 0;      ///< of kernels that trace rays (register_cap)
  std::uint32_t leaf_sure = 2;  ///< triangles: a subtree of at most so many is a leaf, ...
  std::uint32_t leaf_size = 4;  ///< ... of more than so many not (narrow layout)

  friend bool operator==(const choices&, const choices&) = default;
};

/// What that device cannot have: "group: found 5000; 1 to 4096 work-items are allowed". "" if it
/// can have all. A kernel may be allowed less, which its launch tells.
std::string fault_of(const choices& c, const runtime::device& d);

}  // namespace facet::tracer
