// JSON as a file of results holds it: objects opened up, lists of plain values kept on few lines.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace facet::study {

/// Ends with a line break. Lines break after about 100 columns; numbers read back as the same
/// double; bytes that are not UTF-8 (a device's or a file's name may have some) become U+FFFD.
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace facet::study
