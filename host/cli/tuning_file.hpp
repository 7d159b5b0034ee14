// Where the user's table of tuned defaults lies, and what of it holds for a device.
#pragma once

#include <filesystem>
#include <optional>

#include "cli/console.hpp"
#include "runtime/device.hpp"
#include "tracer/choices.hpp"

namespace facet::cli {

/// $FACET_TUNING; or facet/tuning.json in $XDG_CONFIG_HOME, or else in ~/.config. Empty if
/// FACET_TUNING is set and empty, which does without a table, or if there is no home.
std::filesystem::path tuning_path();

/// What was measured for the device under its driver, or none; -v says which, and a note where the
/// table knows the device under another driver. `is_off`: none, without a look.
/// Throws study::tuning_error for a table that cannot be used.
std::optional<tracer::choices> tuned_defaults(const runtime::device& d, bool is_off,
                                              const console& say);

}  // namespace facet::cli
