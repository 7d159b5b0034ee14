// Writing picture files through OpenImageIO. Here only if the option FACET_OPENIMAGEIO is on.
#pragma once

#include <filesystem>

#include "image/transfer.hpp"
#include "scene/picture.hpp"

namespace facet::image {

/// Writes by extension, in any case. ".png": RGBA of 8 bits, clamped and curved, with the curve
/// noted in the file. ".exr": RGBA float, linear, not clamped. All four channels are stored as
/// they are: alpha neither multiplies nor divides the colours. Throws nan_error or output_error;
/// the file is whole or as it was before (output.hpp). Other extensions: std::invalid_argument.
void write_picture(const std::filesystem::path& path, const picture& p,
                   transfer curve = transfer::srgb);

}  // namespace facet::image
