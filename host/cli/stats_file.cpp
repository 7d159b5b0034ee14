#include "cli/stats_file.hpp"

#include <nlohmann/json.hpp>

#include "image/output.hpp"
#include "study/statistics.hpp"

namespace facet::cli {

nlohmann::ordered_json to_json(const tracer::statistics& s) {
  const double kernel_ms = study::summarize(s.kernel_ms).median;
  return {{"version", FACET_VERSION},
          {"device", s.device},
          {"platform", s.platform},
          {"driver", s.driver},
          {"rays", s.rays},
          {"refused", s.refused},
          {"crowded", s.crowded},
          {"kernel_ms", kernel_ms},
          {"kernel_ms_all", s.kernel_ms},
          {"mrays_per_s", kernel_ms > 0 ? double(s.rays) / kernel_ms / 1000 : 0},
          {"compile_ms", s.compile_ms},
          {"upload_ms", s.upload_ms},
          {"build_ms", s.build_ms},
          {"wall_ms", s.wall_ms},
          {"work_group", {s.group_width, s.group_height}},
          {"tiles", s.tiles},
          {"geometry", s.geometry},
          {"layout", s.layout},
          {"rays_a_work_item", s.rays_a_work_item},
          {"tuned", s.is_tuned},
          {"features", s.features},
          {"tree_depth", s.tree_depth},
          {"tree_nodes", s.tree_nodes},
          {"device_bytes", s.device_bytes},
          {"peak_bytes", s.peak_bytes}};
}

void write_json(const std::filesystem::path& path, const nlohmann::ordered_json& content) {
  // A device's or a file's name need not be UTF-8.
  image::write_file(
      path, content.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

}  // namespace facet::cli
