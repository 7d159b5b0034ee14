// What a sweep of work-groups found: raw times in order, and what follows from them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/provenance.hpp"
#include "study/shape.hpp"
#include "study/statistics.hpp"
#include "study/times.hpp"
#include "tracer/tracer.hpp"

namespace facet::study {

struct sweep_settings {
  std::vector<shape> shapes;
  unsigned repeats = 10;           ///< timed, of each shape
  unsigned serial_repeats = 10;    ///< timed; 0 leaves the serial reference out
  std::uint32_t seed = 1;          ///< of the order and of the intervals
  std::uint32_t resamples = 2000;  ///< a bootstrap
  double level = 0.95;             ///< of the intervals
  /// Tree and work-group are overridden; a tile of 0 x 0 pixels is the whole picture, not 50 ms.
  tracer::options tracer;
};

/// How often faster than the serial reference: median over median. 0 without either.
struct speed_up {
  double value = 0;
  interval range;
};

enum class standing {
  measured,
  refused,     ///< the device cannot run it
  different,   ///< its picture is not the first shape's: its times count for nothing
  unfinished,  ///< interrupted before all its repeats
};

struct shape_result {
  shape of;
  standing state = standing::unfinished;
  std::string reason;                          ///< why it was refused, or how its picture differs
  std::uint64_t differs = 0;                   ///< pixels
  std::uint32_t differs_x = 0, differs_y = 0;  ///< the first of them, row by row from the top
  double warm_up_ms = 0;                       ///< host clock, compiling for this shape included
  times kernel;                                ///< by the device's events
  times wall;  ///< host clock, from the launch until the picture is on the host
  speed_up by_kernel, by_wall;
};

struct serial_result {
  double build_ms = 0;  ///< its tree
  times wall;           ///< host clock
  /// Pixels that differ from the device's picture by more than 1/255 in a channel.
  std::uint64_t pixels_off = 0;
};

struct experiment_result {
  std::string name, scene_name, scene_hash;
  std::uint64_t triangles = 0, instances = 0;  ///< triangles: of all instances
  std::uint32_t width = 0, height = 0, max_depth = 0, samples = 0;
  std::string tree;                             ///< "none" or "levels"
  std::string kernel_hash, text_hash, options;  ///< of text and options; of the text alone
  std::string features, geometry;
  std::uint64_t group_items = 0;  ///< the most that the kernel can have, as compiled
  std::uint32_t tree_depth = 0;
  std::uint64_t tree_nodes = 0, device_bytes = 0;
  double compile_ms = 0, upload_ms = 0, build_ms = 0;
  serial_result serial;
  std::vector<shape_result> shapes;  ///< as in the settings
  /// The timed runs in their order: an index into `shapes`, or shapes.size() for the serial one.
  std::vector<std::uint32_t> order;
  /// Indices of the shapes whose intervals of kernel time overlap the best one's; empty unless
  /// complete.
  std::vector<std::uint32_t> best;
  bool complete = false;
};

/// An experiment that was not begun on purpose.
struct omission {
  std::string experiment, reason;
};

struct sweep_result {
  bool complete = false;
  origin from;
  sweep_settings settings;
  std::vector<experiment_result> experiments;  ///< those begun
  std::vector<omission> left_out;              ///< for the caller to fill in

  bool has_samples() const;
  /// A line each, naming experiment, shape and pixel.
  std::vector<std::string> differences() const;
};

/// Fills what follows from an experiment's raw times: summaries, intervals, speed-ups, the best.
void conclude(experiment_result& e, const sweep_settings& settings);

}  // namespace facet::study
