// The text of a table of tuned defaults (bench/facet-tuning.schema.json): a device's entry put in
// or taken out, the others as they were.
#pragma once

#include <filesystem>
#include <string>

#include "study/tuning_result.hpp"
#include "study/tuning_table.hpp"

namespace facet::study {

/// The table at `path`, or a new one, with a complete result's entry in place of any for the same
/// device and driver. Throws tuning_error as read_tuning_table does.
std::string table_with(const std::filesystem::path& path, const tuning_result& r);
/// A table of that entry alone.
std::string table_of(const tuning_result& r);

/// The table at `path` without all entries for that device, whatever their driver.
std::string table_without(const std::filesystem::path& path, const tuned_device& d);

}  // namespace facet::study
