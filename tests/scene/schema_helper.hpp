// A checker for the part of JSON Schema 2020-12 that scenes/facet-scene.schema.json uses.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace facet::test {

/// The published schema.
const nlohmann::json& scene_schema();

/// The first fault of `value` under `schema` ("/camera: not an object"), or "" if there is none.
/// References are resolved in scene_schema(). Throws std::logic_error for a keyword that it does
/// not know, so that no rule of the schema is passed over in silence.
std::string schema_fault(const nlohmann::json& value, const nlohmann::json& schema,
                         const std::string& place = "");

}  // namespace facet::test
