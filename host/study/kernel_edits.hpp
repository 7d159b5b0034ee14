// Edits of the kernels that more than one study makes: what a tracer does that is not exact.
#pragma once

#include <initializer_list>
#include <vector>

#include "tracer/tracer.hpp"

namespace facet::study {

using kernel_edits = std::vector<tracer::kernel_edit>;

/// The ray's direction beside what the exact test needs of it: s->direction.
kernel_edits with_direction();

/// The test of Moeller and Trumbore (Journal of Graphics Tools 2, 1997), leaving as soon as it can:
/// each triangle decides an edge by itself.
kernel_edits moller_trumbore_test();

/// Slabs without a pad.
kernel_edits unpadded_slabs();

/// t held to the triangle's own interval also where that is sure to change nothing.
kernel_edits always_held();

/// Edge functions as the difference of two rounded products.
kernel_edits rounded_edges();

/// a*b+c may become an fma.
kernel_edits contracted();

kernel_edits joined(std::initializer_list<kernel_edits> parts);

}  // namespace facet::study
