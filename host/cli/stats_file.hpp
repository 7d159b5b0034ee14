// The JSON that --stats writes.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

#include "tracer/tracer.hpp"

namespace facet::cli {

/// The fields of tracer::statistics; kernel_ms is the median, kernel_ms_all the list, mrays_per_s
/// follows from the median.
nlohmann::ordered_json to_json(const tracer::statistics& s);

/// Throws image::output_error.
void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& content);

}  // namespace facet::cli
