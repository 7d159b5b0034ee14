#include "tracer/tuning.hpp"

namespace facet::tracer {

std::string tuning::flags() const {
  std::string options = " -cl-std=CL1.2";
  if (correctly_rounded) options += " -cl-fp32-correctly-rounded-divide-sqrt";
  if (hardware_minmax) options += " -DFACET_HARDWARE_MINMAX";
  if (!more_flags.empty()) options += " " + more_flags;
  return options;
}

void tuning::build_in_groups() {
  serial_trees = false;
  list_group = 256;
  list_each = 4;
  scan_group = 256;
}

void tuning::build_alone() {
  serial_trees = true;
  list_group = 1;
  list_each = 1024;
  scan_group = 1;
}

std::string register_cap(std::uint32_t registers) {
  return registers == 0 ? "" : " -cl-nv-maxrregcount=" + std::to_string(registers);
}

tuning tuning_for(const runtime::device& d) {
  tuning t;
  t.correctly_rounded = d.has_correctly_rounded_divide_sqrt();
  t.hardware_minmax = d.is_gpu();
  t.wide_layout = !d.is_gpu();
  t.packets = !d.is_gpu();
  if (d.is_gpu()) t.block_run = 1;
  t.sort = sort_tuning_for(d);
  t.bounds_groups = 4 * d.max_compute_units();
  // The compiler takes 61 by itself, and 2% more time: the cap changes its order of instructions.
  if (d.nvidia_compute_capability() > 0) t.trace_registers = 64;
  t.warps = d.nvidia_compute_capability() >= 70;
  if (d.is_gpu()) {
    t.bounds_group = 256;
    t.build_in_groups();
    t.samples_apart = true;
    t.refit_group = 64;
    t.refit_nodes = 8;
  }
  return t;
}

}  // namespace facet::tracer
