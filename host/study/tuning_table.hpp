// The table of tuned defaults: a file that tuning writes and later runs read.
//
// An entry holds for one device, platform and driver version: another version of the driver
// compiles other code, so its entry is not taken. It is kept, and told of.
#pragma once

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/device.hpp"
#include "study/provenance.hpp"
#include "tracer/choices.hpp"

namespace facet::study {

inline constexpr const char* tuning_format = "facet-tuning";
inline constexpr std::uint32_t tuning_version = 2;

/// A table that cannot be used at all. The message names the file, the place in it, what was found
/// and what is allowed, and what to do.
class tuning_error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What an entry is found by.
struct tuned_device {
  std::string name, platform, driver;

  bool is_same_but_for_driver(const tuned_device& d) const {
    return name == d.name && platform == d.platform;
  }
  friend bool operator==(const tuned_device&, const tuned_device&) = default;
};

/// As the file names it: bytes that are not UTF-8 are replaced (json_text.hpp).
tuned_device tuned_device_of(const device_facts& d);

struct tuned_entry {
  tuned_device of;
  std::string date;  ///< UTC
  tracer::choices values;
};

struct tuning_table {
  std::string file;
  std::vector<tuned_entry> entries;

  /// The entry for that device under its driver, or none.
  const tuned_entry* find(const runtime::device& d) const;
  /// One for that device under another version of the driver, or none.
  const tuned_entry* find_other_driver(const runtime::device& d) const;
  /// The values of `find`. Throws tuning_error if the device cannot have them.
  std::optional<tracer::choices> values_for(const runtime::device& d) const;
};

/// All entries, or none if there is no such file. Throws tuning_error for a file that is not a
/// table of this version, or has one entry that is not whole: nothing is taken of it then.
tuning_table read_tuning_table(const std::filesystem::path& path);

/// The values of a table that is to have some for the device. Throws tuning_error, also if it has
/// none.
tracer::choices tuned_values(const std::filesystem::path& path, const runtime::device& d);

}  // namespace facet::study
