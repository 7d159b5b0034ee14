// The option `--streams` of rows that trace rays.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>

#include "tracer/tracer.hpp"

namespace facet::bench {

inline void add_streams_option(CLI::App& row, tracer::stream_kind& streams) {
  const std::map<std::string, tracer::stream_kind> words{{"auto", tracer::stream_kind::automatic},
                                                         {"on", tracer::stream_kind::on},
                                                         {"off", tracer::stream_kind::off}};
  row.add_option("--streams", streams, "rays that do not stay close go through the tree in lists")
      ->transform(CLI::CheckedTransformer(words))
      ->default_str("auto");
}

}  // namespace facet::bench
