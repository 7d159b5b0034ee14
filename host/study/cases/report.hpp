// What the cases found, as a table and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "study/cases/cases.hpp"

namespace facet::study {

/// Of the JSON's format; readers refuse others.
inline constexpr int report_version = 1;

std::string table_head(bool with_mistakes);
/// One line, and one for each finding that is not met or, `detailed`, for each. `caught`: the
/// same case with its mistake, or null.
std::string table_row(const case_report& r, const case_report* caught, bool detailed);

nlohmann::ordered_json to_json(const case_report& r);

}  // namespace facet::study
