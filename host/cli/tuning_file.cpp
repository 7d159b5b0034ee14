#include "cli/tuning_file.hpp"

#include <cstdlib>

#include "study/tuning_table.hpp"

namespace facet::cli {
namespace fs = std::filesystem;

fs::path tuning_path() {
  if (const char* named = std::getenv("FACET_TUNING")) return named;
  const fs::path below = fs::path("facet") / "tuning.json";
  // A path that is not absolute is to be ignored (XDG Base Directory Specification 0.8).
  const char* config = std::getenv("XDG_CONFIG_HOME");
  if (config && fs::path(config).is_absolute()) return config / below;
  const char* home = std::getenv("HOME");
  return home && *home ? home / (".config" / below) : fs::path();
}

std::optional<tracer::choices> tuned_defaults(const runtime::device& d, bool is_off,
                                              const console& say) {
  const fs::path path = is_off ? fs::path() : tuning_path();
  if (path.empty()) return std::nullopt;
  const study::tuning_table table = study::read_tuning_table(path);
  const auto values = table.values_for(d);
  if (values) {
    say.detail("tuned: " + table.find(d)->date + ", " + table.file);
  } else if (const study::tuned_entry* other = table.find_other_driver(d)) {
    say.say("note: " + table.file + " has this device tuned under driver " + other->of.driver +
            ", which is now " + d.driver_version() +
            ": the built-in defaults are taken; `facet tune` measures anew");
  }
  return values;
}

}  // namespace facet::cli
