// Short names for what was measured: equal for equal content on every machine, so that results
// of different scenes or kernels are not taken for one another.
#pragma once

#include <string>

#include "scene/scene.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

/// All that decides a picture but its size and depth: camera, samples, nesting, ambient and
/// background light, materials, lights, instances (mesh, matrix, material), and each mesh's
/// positions, normals, indices and materials, in their order and bit for bit. Not hashed: names,
/// notes, the scene's own width, height and max_depth, and how a file numbered its triangles. One
/// pass over the meshes. "fnv1a64:" and 16 hexadecimal digits (FNV-1a of Fowler, Noll and Vo, 64
/// bits; it tells results apart and keeps out nobody who means harm).
std::string fingerprint_of(const scene& s);

/// A text's, in the same form.
std::string fingerprint_of(const std::string& text);

/// Of a kernel's expanded text and options.
std::string fingerprint_of(const tracer::kernel_description& kernel);

}  // namespace facet::study
