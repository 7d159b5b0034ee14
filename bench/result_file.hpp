// What every row's file of results begins with, and how it is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/provenance.hpp"

namespace facet::bench {

/// Format and version, by which readers know the file; then where it comes from.
nlohmann::ordered_json head_of(const std::string& format, const study::origin& from,
                               int version = 1);

/// Who else was measured, and on how many threads; null if `name` is empty.
nlohmann::ordered_json peer_of(const std::string& name, unsigned threads);

/// A mesh or a scene as results call it: its file without the folders, or the generator's words.
std::string name_of(const std::string& path);

/// The whole file, or what was there before. Throws image::output_error.
void write_result(const std::string& path, const nlohmann::ordered_json& content);

}  // namespace facet::bench
