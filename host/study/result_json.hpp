// What the files of all studies write alike.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "study/provenance.hpp"
#include "study/times.hpp"

namespace facet::study {

/// [low, high]
nlohmann::ordered_json to_json(const interval& i);
/// Every sample, and their summary: null without samples.
nlohmann::ordered_json to_json(const times& t);
/// Date, Facet's version and commit, the device (null if none takes part) and the CPU, in this
/// order.
nlohmann::ordered_json to_json(const origin& from);

}  // namespace facet::study
