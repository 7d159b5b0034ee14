// A whole scene's geometry in the wide layout.
#pragma once

#include <span>

#include "tracer/tree.hpp"

namespace facet::tracer {

/// As build_geometry (tree.hpp), in buffers and in the wide layout: binary trees are built, then
/// cut (cut_tree.hpp) and folded (fold.hpp). is_movable: there is room for any tree over the
/// instances.
device_geometry build_wide_geometry(runtime::queue& q, const runtime::source_tree& kernels,
                                    packed_scene packed, const features& f, tree_kind kind,
                                    const tuning& t, std::span<const given_tree> given,
                                    bool is_movable = false);

}  // namespace facet::tracer
