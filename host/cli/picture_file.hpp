// Picture files by extension: .npy always, others where OpenImageIO was built in.
#pragma once

#include <filesystem>
#include <optional>

#include "image/transfer.hpp"
#include "scene/picture.hpp"

namespace facet::cli {

/// Before the work: is the extension known (usage_error), can the file be made (output_error)?
void check_picture_output(const std::filesystem::path& path);

/// Prepares what write_picture_file will need of other libraries while other work goes on; at once
/// when the device's kernels run.
void prepare_to_write(const std::filesystem::path& path);
void prepare_at_once();

/// Throws image::nan_error or image::output_error; then the file is as it was before.
void write_picture_file(const std::filesystem::path& path, const picture& p, image::transfer curve);

/// Linear RGBA. Throws scene_error.
picture read_picture_file(const std::filesystem::path& path, std::optional<image::transfer> curve);

}  // namespace facet::cli
