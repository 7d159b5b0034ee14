#include "scene/scene_terms.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "scene/generate.hpp"
#include "scene/scene.hpp"
#include "scene/schema_helper.hpp"

using facet::scene_keys;
using facet::test::scene_schema;
using nlohmann::json;

namespace {

std::set<std::string> properties_of(const json& definition) {
  std::set<std::string> names;
  for (const auto& [key, value] : definition.at("properties").items()) names.insert(key);
  return names;
}

std::set<std::string> set_of(const std::vector<std::string>& keys) {
  return {keys.begin(), keys.end()};
}

}  // namespace

TEST_CASE("each key that the reader knows is in the schema, and the other way round") {
  for (const auto& term : facet::scene_terms()) {
    if (term.object == "generated_mesh") continue;  // one definition for each generator, below
    CAPTURE(term.object);
    const json& definition =
        term.object == "scene" ? scene_schema() : scene_schema().at("$defs").at(term.object);
    CHECK(properties_of(definition) == set_of(term.keys));
    CHECK(definition.at("additionalProperties") == false);
  }
}

TEST_CASE("every object of the schema that lists properties is one of the reader's") {
  for (const auto& entry : scene_schema().at("$defs").items()) {
    CAPTURE(entry.key());
    if (entry.value().contains("properties") && entry.key().substr(0, 10) != "generated_")
      CHECK(!scene_keys(entry.key()).empty());
  }
}

TEST_CASE("each generator and its parameters are in the schema, with defaults and limits") {
  const json& definitions = scene_schema().at("$defs");
  CHECK(definitions.at("generated_mesh").at("oneOf").size() == facet::generators().size());
  for (const auto& info : facet::generators()) {
    CAPTURE(info.kind);
    const json& definition = definitions.at("generated_" + info.kind);
    std::set<std::string> keys = set_of(scene_keys("generated_mesh"));
    for (const auto& parameter : info.parameters) {
      CAPTURE(parameter.name);
      keys.insert(parameter.name);
      const json& property = definition.at("properties").at(parameter.name);
      CHECK(property.at("default") == parameter.fallback);
      CHECK(property.at("minimum") == parameter.least);
      CHECK(property.at("maximum") == parameter.most);
      CHECK((property.at("type").dump().find("integer") != std::string::npos) == parameter.whole);
      CHECK(property.value("description", "") == parameter.about);
    }
    CHECK(properties_of(definition) == keys);
    CHECK(definition.at("properties").at("generate").at("const") == info.kind);
    CHECK(definition.at("description") == info.about);
  }
}

TEST_CASE("limits and defaults of the schema are those of the scene model") {
  const json& definitions = scene_schema().at("$defs");
  const json& picture = definitions.at("picture").at("properties");
  const facet::scene s;
  CHECK(picture.at("width").at("maximum") == facet::limits::image_side);
  CHECK(picture.at("max_depth").at("maximum") == facet::limits::max_depth);
  CHECK(picture.at("samples").at("maximum") == facet::limits::samples);
  CHECK(picture.at("width").at("default") == s.width);
  CHECK(picture.at("height").at("default") == s.height);
  CHECK(picture.at("max_depth").at("default") == s.max_depth);
  CHECK(picture.at("samples").at("default") == s.samples);
  CHECK(scene_schema().at("properties").at("nesting").at("maximum") == facet::limits::nesting);
  CHECK(scene_schema().at("properties").at("nesting").at("default") == s.nesting);
  CHECK(scene_schema().at("properties").at("lights").at("maxItems") == facet::limits::lights);
  CHECK(scene_schema().at("properties").at("instances").at("maxItems") == facet::limits::instances);
  CHECK(definitions.at("camera").at("properties").at("vertical_fov").at("default") ==
        s.view.vertical_fov);
  const facet::material m;
  const json& material = definitions.at("material").at("properties");
  CHECK(material.at("Kd").at("default").get<float>() == m.Kd.x);
  CHECK(material.at("Ns").at("default").get<float>() == m.Ns);
  CHECK(material.at("Ni").at("default").get<float>() == m.Ni);
  CHECK(material.at("attenuation_distance").at("default").get<float>() == m.attenuation_distance);
}
