// The rows of facet_bench: each adds its subcommand, which prints a table and may write JSON.
#pragma once

#include <CLI/CLI.hpp>

namespace facet::bench {

/// The serial reference against Embree, one thread each, closest hits.
void add_reference_row(CLI::App& app);

/// An OpenCL device against Embree: primary, shadow and bounce rays.
void add_trace_row(CLI::App& app);

/// An OpenCL device's builders of trees against Embree's.
void add_build_row(CLI::App& app);

/// The strict kernel against variants of it whose hits are not exact.
void add_exactness_row(CLI::App& app);

/// Whole pictures of a device against the serial reference in float and double.
void add_pictures_row(CLI::App& app);

/// Whole pictures on a device, by several ways, rays counted by kind.
void add_render_row(CLI::App& app);

/// Time against triangles, with a tree, without one, and by the serial reference.
void add_growth_row(CLI::App& app);

/// The device's radix sort against std::sort and TBB.
void add_sort_row(CLI::App& app);

/// From a binary tree to the wide layout on a device.
void add_fold_row(CLI::App& app);

/// Scenes that move on a device against ones that are made anew.
void add_move_row(CLI::App& app);

/// What rays visit, and the device's own rates beside theirs.
void add_limits_row(CLI::App& app);

}  // namespace facet::bench
