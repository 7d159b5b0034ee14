#include "tracer/choices.hpp"

#include <algorithm>

namespace facet::tracer {
namespace {

constexpr std::uint32_t most_leaf = 16;  // leaf_rule.hpp
constexpr std::uint32_t least_registers = 16, most_registers = 255;

std::string out_of_range(const std::string& name, std::uint64_t found, std::uint64_t least,
                         std::uint64_t most, const std::string& unit) {
  if (found >= least && found <= most) return "";
  return name + ": found " + std::to_string(found) + "; " + std::to_string(least) + " to " +
         std::to_string(most) + " " + unit + " are allowed";
}

std::string register_fault(std::uint32_t registers, const runtime::device& d) {
  if (registers == 0) return "";
  if (d.nvidia_compute_capability() == 0)
    return "trace_registers: found " + std::to_string(registers) +
           "; 0 alone is allowed where the driver is not NVIDIA's";
  if (registers >= least_registers && registers <= most_registers) return "";
  return "trace_registers: found " + std::to_string(registers) + "; 0, or " +
         std::to_string(least_registers) + " to " + std::to_string(most_registers) +
         " registers a work-item are allowed";
}

}  // namespace

std::string fault_of(const choices& c, const runtime::device& d) {
  if (c.wide_layout && c.image_geometry)
    return "layout, geometry: found wide with image; images are for the narrow layout";
  if (c.image_geometry && !d.image_support())
    return "geometry: found image; the device has no images, and buffer alone is allowed";
  const std::size_t most = d.max_work_group_size();
  const auto sides = d.max_work_item_sizes();
  const std::uint64_t items = std::uint64_t(c.render_group_width) * c.render_group_height;
  const std::size_t most_in_line = std::min(most, sides[0]);
  for (const std::string& fault :
       {out_of_range("packet_group", c.packet_group, 1, most_in_line, "work-items"),
        out_of_range("group", c.group, 1, most_in_line, "work-items"),
        out_of_range("render_group's width", c.render_group_width, 1, sides[0], "work-items"),
        out_of_range("render_group's height", c.render_group_height, 1, sides[1], "work-items"),
        out_of_range("render_group", items, 1, most, "work-items in all"),
        register_fault(c.trace_registers, d),
        out_of_range("leaf_size", c.leaf_size, 1, most_leaf, "triangles"),
        out_of_range("leaf_sure", c.leaf_sure, 1, c.leaf_size, "triangles (leaf_size at most)")})
    if (!fault.empty()) return fault;
  return "";
}

}  // namespace facet::tracer
