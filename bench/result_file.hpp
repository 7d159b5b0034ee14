// What every row's file of results begins with, and how it is written.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/device.hpp"
#include "study/provenance.hpp"

namespace facet::bench {

/// Where a result comes from.
struct origin {
  std::string date, cpu;
  std::optional<study::device_facts> device;  ///< none where no OpenCL device takes part
};

origin origin_now(const runtime::device& d);
origin origin_now();

/// Format and version, by which readers know the file; then date, Facet's version and commit, the
/// device (null if none takes part) and the CPU.
nlohmann::ordered_json head_of(const std::string& format, const origin& from, int version = 1);

/// Who else was measured, and on how many threads; null if `name` is empty.
nlohmann::ordered_json peer_of(const std::string& name, unsigned threads);

/// The whole file, or what was there before. Throws image::output_error.
void write_result(const std::string& path, const nlohmann::ordered_json& content);

}  // namespace facet::bench
