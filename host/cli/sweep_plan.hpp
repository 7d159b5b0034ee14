// Which experiments a sweep runs, on which scenes, and how large their pictures are.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "cli/options.hpp"
#include "scene/scene.hpp"
#include "study/sweep.hpp"

namespace facet::cli {

/// no-tree: SCENE, every triangle tested for every ray. tree: SCENE. large: a larger scene.
const std::vector<std::string>& sweep_experiments();

struct sweep_request {
  std::string scene;
  std::string large;                             ///< "": hills of 500,000 triangles
  std::optional<std::vector<std::string>> only;  ///< of sweep_experiments(); none: all that can be
  size picture;                   ///< a side of 0 follows from the other, or by default
  std::uint32_t brute_width = 0;  ///< of the picture without a tree; 0: by default
  std::optional<std::uint32_t> max_depth;
};

/// The scenes, kept alive, and the experiments on them.
struct sweep_plan {
  scene given, large;
  std::vector<study::experiment> experiments;
  std::vector<study::omission> left_out;
};

/// Loads the scenes. Pictures are 1280 pixels wide on a GPU and 256 elsewhere, divided by the side
/// of SCENE's grid of samples; without a tree halved until eye rays times triangles are at most 250
/// million on a GPU and 10 million elsewhere. If less than 64 pixels of width would be left, that
/// experiment is left out, or refused (usage_error) if it was asked for by name. Throws scene_error
/// and memory_error, too.
std::unique_ptr<sweep_plan> plan_sweep(const sweep_request& request, bool on_gpu,
                                       const console& say);

}  // namespace facet::cli
