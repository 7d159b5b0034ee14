// How large a picture is, of which the command line may give one side, both or none.
#pragma once

#include <cstdint>

#include "cli/options.hpp"

namespace facet::cli {

/// --width and --height, in pixels; 0 where they are not given.
void add_picture_size(CLI::App& app, std::uint32_t& width, std::uint32_t& height);

/// `asked`, where a side of 0 follows from the other and the aspect ratio of `own`; with both 0 it
/// is `own`. Throws usage_error if the side that follows is beyond limits::image_side.
size picture_size(size asked, size own);

}  // namespace facet::cli
