// Wavefront MTL: the materials of an OBJ file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/material.hpp"

namespace facet {

/// Ke, Ka, Kd, Ks, Ns and Ni are taken as they are; what a material does not state is 0 (Ns 32,
/// Ni 1), and a material that states no colour at all has the default Kd. The rest is a reading:
///
/// - Mirrors: under illum 3, 5 and 8 (the models with ray-traced or fixed reflection), Kr = Ks.
/// - Glass: illum 4, 6, 7 and 9 make a material transparent with Kt = Tf. Tf absent or white leaves
///   the strength to d: Kt = 1 - d, or white if d is 1.
/// - Not glass: Tf 1 1 1 with Ni 1 and d 1 says "invisible" but is what exporters write on opaque
///   materials; those stay opaque. So does any Tf without such an illum and with d = 1.
/// - Dissolve: d < 1 (or Tr = 1 - d > 0) scales Ka and Kd by d. Under any other illum it lets
///   through Kt = Tf, or 1 - d if Tf is absent or white, without refraction (Ni 1) and without
///   absorption along the way (attenuation 1 1 1): a dissolve has no thickness.
/// - Textures (map_*, bump, disp, decal, refl, norm) are not offered: a note says so. A material
///   with map_Kd and no Kd, or a black one, has the default Kd.
///
/// Negative values become 0, and Kr, Kt, d and Tr above 1 become 1, each with a note. Of two
/// materials of one name the later counts. Throws scene_error if the file cannot be read, or with
/// the line where a value is not a finite number.
std::vector<material> read_mtl(const std::filesystem::path& path, std::vector<std::string>& notes);

}  // namespace facet
