// Other ways to trace, each as an edit of the kernels: what speed is bought with error, or with
// nothing.
#pragma once

#include <string>
#include <vector>

#include "tracer/tracer.hpp"

namespace facet::study {

/// How kernels differ from those of the library.
struct variant {
  std::string name, about;
  std::vector<tracer::kernel_edit> edits{};
  std::string flags{};  ///< of the compiler, each with a space before it
};

/// The options of a tracer that is so changed.
tracer::options with(const variant& v, tracer::options o);

/// Without any of what makes hits exact: no padded slabs, no interval that t is held to, no
/// smallest id, no refused rays; the test of Moeller and Trumbore, or ours with plain edge
/// functions; each in strict arithmetic, with contraction, and with all that -cl-fast-relaxed-math
/// allows.
std::vector<variant> inexact_variants();

/// The strict kernel without one of its guards at a time: what each costs.
std::vector<variant> single_guards();

/// The strict kernel in other arithmetic: with contraction, and with all that -cl-fast-relaxed-math
/// allows.
std::vector<variant> other_arithmetic();

}  // namespace facet::study
