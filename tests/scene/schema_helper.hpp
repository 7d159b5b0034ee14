// A checker for the part of JSON Schema 2020-12 that Facet's schemas use.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace facet::test {

/// The published schema of scenes.
const nlohmann::json& scene_schema();

/// The first fault of `value` under `schema` ("/camera: not an object"), or "" if there is none.
/// Throws std::logic_error for a keyword that it does not know, so that no rule of the schema is
/// passed over in silence.
std::string schema_fault(const nlohmann::json& value, const nlohmann::json& schema);

}  // namespace facet::test
