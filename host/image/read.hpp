// Reading picture files through OpenImageIO. Here only if the option FACET_OPENIMAGEIO is on.
#pragma once

#include <filesystem>
#include <optional>

#include "image/transfer.hpp"
#include "scene/picture.hpp"

namespace facet::image {

/// Reads any picture file that OpenImageIO knows into linear RGBA. Files of 8 or 16 bits go
/// through `curve`; where it is not given, the file says (its gamma chunk) or it is sRGB. Floats
/// are linear and taken as they are. Grey becomes RGB, and without an alpha channel it is 1.
/// Throws scene_error for a file that is missing, damaged, of an unknown kind or beyond
/// limits::image_side.
picture read_picture(const std::filesystem::path& path,
                     std::optional<transfer> curve = std::nullopt);

}  // namespace facet::image
