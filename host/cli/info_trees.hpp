// facet info --tree: how good the trees of a scene are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cli/console.hpp"
#include "scene/scene.hpp"
#include "tracer/tracer.hpp"

namespace facet::cli {

struct trees_request {
  std::vector<std::string> builders;  ///< words of study::tree_makers()
  std::string device, json;           ///< "": none is written
  tracer::options tracer;
  std::uint64_t samples = 10000, seed = 1;
};

/// Measures, prints a table and writes the file. Throws as the subcommands do.
void print_trees(const scene& s, const trees_request& r, const console& say);

}  // namespace facet::cli
