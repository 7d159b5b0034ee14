#include "study/json_text.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>
#include <vector>

using facet::study::json_text;
using json = nlohmann::ordered_json;

TEST_CASE("objects are opened up, lists of plain values stay on a line") {
  const json value{{"name", "a"},
                   {"list", {1, 2.5, "x"}},
                   {"empty", json::object()},
                   {"none", json::array()},
                   {"deep", {{{"k", nullptr}}, {{"k", true}}}}};
  CHECK(json_text(value) == R"({
  "name": "a",
  "list": [1, 2.5, "x"],
  "empty": {},
  "none": [],
  "deep": [
    {
      "k": null
    },
    {
      "k": true
    }
  ]
}
)");
}

TEST_CASE("long lists break at about 100 columns, and all reads back as it was") {
  std::vector<double> many(200);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = 1 / double(i + 3);
  const json value{{"many", many}, {"strings", std::vector<std::string>(60, "16x16")}};
  const std::string text = json_text(value);
  std::size_t longest = 0, at = 0;
  for (std::size_t end; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    longest = std::max(longest, end - at);
  CHECK(longest <= 100);
  CHECK(longest > 80);
  CHECK(json::parse(text) == value);
}

TEST_CASE("bytes that are not UTF-8 are replaced") {
  CHECK(json_text(json{{"name", "a\xff"}}).find("a\xef\xbf\xbd") != std::string::npos);
}
