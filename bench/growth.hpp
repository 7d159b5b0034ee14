// Time against triangles: one family of meshes at growing sizes, traced with the device's tree,
// without one, and by the serial float reference.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bench/result_file.hpp"
#include "runtime/queue.hpp"
#include "study/times.hpp"
#include "tracer/tracer.hpp"

namespace facet::bench {

struct growth_settings {
  std::vector<std::string> families{"terrain", "soup"};  ///< words of load_workload
  std::vector<std::uint64_t> triangles;                  ///< asked for, ascending
  int width = 640, height = 360;                         ///< of the picture that eye rays are of
  unsigned repeats = 10;                                 ///< timed, of each figure
  unsigned builds = 3;                                   ///< timed, of the device's tree
  /// Seconds that the figure of a way without the device's tree may take, all repeats together.
  double budget_s = 20;
  std::string geometry = "auto";  ///< "auto", "buffer" or "image"
  study::resampling drawing;
};

/// How rays are traced. The serial reference is on one thread and has a tree of its own.
enum class way { tree, no_tree, serial };
inline constexpr std::array ways{way::tree, way::no_tree, way::serial};
/// "tree", "no-tree", "serial".
const char* word_of(way w);

/// One kind of rays.
struct growth_figure {
  std::string rays;  ///< "eye", "shadow" or "bounce"
  std::uint64_t count = 0;
  double warm_up_ms = 0;  ///< the first pass, timed as the others
  study::times time;      ///< by the device's events; of the serial reference, host clock
  /// Rays whose hit is not, bit for bit, that of the device with its tree; none without that.
  std::optional<std::uint64_t> differing_hits;
};

struct growth_point {
  std::string mesh, scene_hash;  ///< "terrain:22"
  std::uint64_t triangles = 0;
  study::times build;  ///< host clock; without a tree, moving the triangles to their place
  double upload_ms = 0, compile_ms = 0;
  std::uint32_t tree_depth = 0;
  std::uint64_t device_bytes = 0;
  std::string geometry;  ///< as chosen; empty for the serial reference
  std::vector<growth_figure> figures;
};

/// Why a series holds no larger mesh.
struct growth_end {
  std::uint64_t triangles;  ///< asked for
  std::string reason;
};

struct growth_series {
  way by = way::tree;
  std::vector<growth_point> points;
  std::optional<growth_end> ended;
};

struct growth_family {
  std::string name;
  std::array<growth_series, ways.size()> series;
};

struct growth_result {
  bool complete = false;
  study::origin from;
  std::string kernel_hash;  ///< of trace.cl's expanded text
  growth_settings settings;
  std::vector<growth_family> families;

  /// Of all figures.
  std::uint64_t differing_hits() const;
};

/// Called after each size with what has been found so far: families.back() holds it.
using growth_watch = std::function<void(const growth_result&)>;

/// A size that does not fit (device or host memory, an image's limits) or would take more than the
/// budget ends its series, and the reason is kept; other errors are thrown.
growth_result measure_growth(const runtime::queue& queue, const growth_settings& s,
                             const growth_watch& watch);

/// As facet-growth.schema.json has it.
nlohmann::ordered_json to_json(const growth_result& r);

}  // namespace facet::bench
