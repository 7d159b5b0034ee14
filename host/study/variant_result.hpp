// What the study of speed against error found.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "study/hit_errors.hpp"
#include "study/picture_errors.hpp"
#include "study/provenance.hpp"
#include "study/times.hpp"
#include "study/variant_list.hpp"

namespace facet::study {

struct variant_settings {
  std::uint32_t width = 0, height = 0;
  unsigned repeats = 10;           ///< timed, of each variant
  std::uint32_t seed = 1;          ///< of the order, of the bounce rays and of the intervals
  std::uint32_t resamples = 2000;  ///< a bootstrap
  double level = 0.95;             ///< of the intervals
  unsigned threads = 1;            ///< of the host, for the oracle
};

/// One set of rays, traced by one variant.
struct traced_rays {
  times kernel;
  hit_errors errors;

  double mrays_per_s() const {
    return kernel.values.median > 0 ? double(errors.rays) / kernel.values.median * 1e-3 : 0;
  }
};

enum class variant_state {
  measured,
  refused,     ///< the device cannot run or compile it
  unfinished,  ///< interrupted before all its repeats
};

struct variant_result {
  listed_variant of;
  variant_state state = variant_state::unfinished;
  std::string reason;         ///< why it was refused
  bool is_judged = false;     ///< its errors are known
  bool is_repeatable = true;  ///< each of its pictures had the same bits
  std::string kernel_hash, text_hash, compiler_options, features, geometry;
  std::uint64_t group_items = 0, device_bytes = 0, tree_nodes = 0;
  std::uint32_t tree_depth = 0;
  double compile_ms = 0, upload_ms = 0, build_ms = 0;
  double warm_up_ms = 0;  ///< the first picture, host clock
  times picture;          ///< the kernel's, by the device's events
  /// Rays of one picture: eye, reflected, refracted and shadow rays, counted by the strict kernel
  /// where a variant changes how rays are traced, else by its own.
  std::uint64_t rays = 0;
  /// Eye rays, bounce rays. Those of a variant that changes shading alone are the strict one's.
  std::array<traced_rays, 2> hits;
  picture_errors picture_error;

  double mrays_per_s() const {
    return picture.values.median > 0 ? double(rays) / picture.values.median * 1e-3 : 0;
  }
  /// Of both sets together, per million rays.
  double per_million(std::uint64_t hit_errors::*count) const;
  double wrong_per_million() const;
};

struct omitted_variant {
  std::string name, reason;
};

struct variants_result {
  bool complete = false;
  origin from;
  variant_settings settings;
  std::string scene_name, scene_hash;
  std::uint64_t triangles = 0, instances = 0;  ///< triangles: of all instances
  std::uint32_t max_depth = 0, samples = 0;
  double oracle_ms = 0;  ///< the double reference: its trees, hits and picture
  std::vector<variant_result> variants;
  std::vector<std::uint32_t> order;       ///< the timed runs: indices into `variants`
  std::vector<omitted_variant> left_out;  ///< for the caller to fill in

  /// Is any variant's error known?
  bool has_findings() const;
  /// A line for each exact variant whose hits or picture are not the strict one's.
  std::vector<std::string> broken_promises() const;
};

/// Fills what follows from raw times.
void conclude(variants_result& r);

}  // namespace facet::study
