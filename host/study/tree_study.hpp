// The trees of a scene, builder by builder, beside those of the full sweep.
#pragma once

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/queue.hpp"
#include "scene/scene.hpp"
#include "study/end_point_overlap.hpp"
#include "study/provenance.hpp"
#include "study/tree_quality.hpp"

namespace facet::study {

struct tree_settings {
  std::vector<std::string> makers;  ///< words of tree_makers()
  tracer::options tracer;           ///< layout and geometry; the tree is the makers'
  std::uint64_t samples = 10000;   ///< triangles that overlap is measured of, where a mesh has more
  std::uint64_t seed = 1;          ///< of the samples
  std::uint32_t most_in_leaf = 4;  ///< of the binary trees' best leaves
};

/// A tree, and what the full sweep's comes to in the same layout.
struct measured_tree {
  tree_quality as_traced;
  end_point_overlap overlap;
  double binary_cost = 0;  ///< cost_with_best_leaves of what the layout was folded from
  double sweep_cost = 0, sweep_overlap = 0, sweep_binary_cost = 0;
};

/// All trees of one maker.
struct maker_result {
  std::string maker, layout;          ///< "wide" or "narrow"
  std::uint64_t device_bytes = 0;     ///< of the whole scene, as allocated
  std::vector<measured_tree> meshes;  ///< by trees_result::meshes
  std::optional<tree_quality> top;    ///< over instances
};

struct trees_result {
  origin from;
  std::string scene_name, scene_hash;
  tree_settings settings;
  struct mesh_facts {
    std::string name;
    std::uint64_t triangles;
  };
  std::vector<mesh_facts> meshes;  ///< those that are shown and have triangles
  std::vector<maker_result> makers;
};

/// Builds and reads each maker's trees, and the full sweep's. Calls `watch` with what is done of
/// all before each step; what that throws ends the work. Throws runtime::exception for what the
/// device refuses.
trees_result measure_trees(const runtime::queue& queue, const scene& s, const tree_settings& o,
                           const std::function<void(std::uint64_t, std::uint64_t)>& watch);

/// As bench/facet-trees.schema.json has it.
nlohmann::ordered_json to_json(const trees_result& r);

}  // namespace facet::study
