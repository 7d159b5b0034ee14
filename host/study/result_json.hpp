// What files of results have in common: where they come from, and repeated times.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/provenance.hpp"
#include "study/times.hpp"

namespace facet::study {

/// The samples and, if there are any, their summary.
nlohmann::ordered_json to_json(const times& t);
nlohmann::ordered_json to_json(const interval& i);
nlohmann::ordered_json to_json(const device_facts& d);

/// What a file begins with: format, version, `date`, Facet's own version and commit.
nlohmann::ordered_json result_head(const std::string& format, int version, const std::string& date);

}  // namespace facet::study
