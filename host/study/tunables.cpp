#include "study/tunables.hpp"

#include <stdexcept>
#include <utility>

namespace facet::study {
namespace {

using tracer::choices;
using values = std::vector<choices>;

bool is_by_packets(const choices& c) { return c.wide_layout && c.packets; }

// layout, with where triangles are read from, and whether by packets, since one asks for another.

values layouts(const choices& so_far, const runtime::device& d) {
  values all(4, so_far);
  for (choices& c : all) c.wide_layout = c.image_geometry = c.packets = false;
  all[1].wide_layout = true;
  all[2].wide_layout = all[2].packets = true;
  all[3].image_geometry = true;
  if (!d.image_support()) all.pop_back();
  return all;
}

std::string layout_text(const choices& c) {
  if (c.wide_layout) return c.packets ? "wide, packets" : "wide";
  return c.image_geometry ? "narrow, image" : "narrow, buffer";
}

// Work-groups.

template <std::uint32_t choices::*size>
values sizes(const choices& so_far, std::initializer_list<std::uint32_t> tried) {
  values all;
  for (const std::uint32_t n : tried) all.emplace_back(so_far).*size = n;
  return all;
}

values packet_groups(const choices& so_far, const runtime::device&) {
  return sizes<&choices::packet_group>(so_far, {1, 2, 4, 8, 16, 32});
}

values groups(const choices& so_far, const runtime::device&) {
  return sizes<&choices::group>(so_far, {32, 64, 128, 256});
}

values render_groups(const choices& so_far, const runtime::device&) {
  values all;
  for (const auto& [width, height] :
       {std::pair{4u, 8u}, {8u, 4u}, {8u, 8u}, {8u, 16u}, {16u, 2u}, {16u, 8u}, {32u, 1u}}) {
    choices& c = all.emplace_back(so_far);
    c.render_group_width = width, c.render_group_height = height;
  }
  return all;
}

// registers, which NVIDIA's compiler alone can be told.

values registers(const choices& so_far, const runtime::device& d) {
  if (d.nvidia_compute_capability() == 0) return {};
  return sizes<&choices::trace_registers>(so_far, {0, 40, 48, 56, 64, 72, 80, 96, 128});
}

// leaves.

values leaves(const choices& so_far, const runtime::device&) {
  values all;
  for (const auto& [sure, size] :
       {std::pair{1u, 2u}, {2u, 2u}, {1u, 4u}, {2u, 4u}, {4u, 4u}, {2u, 6u}, {4u, 8u}}) {
    choices& c = all.emplace_back(so_far);
    c.leaf_sure = sure, c.leaf_size = size;
  }
  return all;
}

// Which workloads each matters to.

bool to_all(const choices&, const tuning_workload&) { return true; }
bool to_packets(const choices& c, const tuning_workload&) { return is_by_packets(c); }
bool to_rays_alone(const choices& c, const tuning_workload& w) {
  return !w.is_picture && !is_by_packets(c);
}
bool to_whole_pixels(const choices& c, const tuning_workload& w) {
  return w.is_picture && !is_by_packets(c);
}
bool to_narrow(const choices& c, const tuning_workload&) { return !c.wide_layout; }

// How values are printed.

std::string packet_group_text(const choices& c) { return std::to_string(c.packet_group); }
std::string group_text(const choices& c) { return std::to_string(c.group); }
std::string render_group_text(const choices& c) {
  return std::to_string(c.render_group_width) + "x" + std::to_string(c.render_group_height);
}
std::string registers_text(const choices& c) { return std::to_string(c.trace_registers); }
std::string leaves_text(const choices& c) {
  return std::to_string(c.leaf_sure) + " to " + std::to_string(c.leaf_size);
}

const tunable all_tunables[] = {
    {"layout", "nodes of two children or of eight, in buffers or images; rays alone or in packets",
     layouts, to_all, layout_text},
    {"packet_group", "work-items a group of kernels by packets", packet_groups, to_packets,
     packet_group_text},
    {"group", "work-items a group of kernels over rays", groups, to_rays_alone, group_text},
    {"render_group", "work-items a group of the kernel for whole pixels", render_groups,
     to_whole_pixels, render_group_text},
    {"registers", "the most that NVIDIA's compiler gives a work-item; 0: as many as it likes",
     registers, to_all, registers_text},
    {"leaves", "triangles that are a leaf at once, and those that it has at most (narrow layout)",
     leaves, to_narrow, leaves_text},
};

}  // namespace

std::span<const tunable> tunables() { return all_tunables; }

const tunable& tunable_of(const std::string& name) {
  for (const tunable& t : all_tunables)
    if (t.name == name) return t;
  throw std::out_of_range("no tunable is called " + name);
}

}  // namespace facet::study
