// Benches measure the built-in defaults, or a table's values if they are given one.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

outcome bench(const temporary_folder& folder, std::vector<std::string> more) {
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{
      "render", (folder / "s.json").string(), "--way", "default", "--width", "32", "--repeat", "1",
      "--json", (folder / "r.json").string()};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

}  // namespace

TEST_CASE("a bench takes a table's values for its device, and refuses a table without any") {
  const temporary_folder folder;
  if (bench(folder, {}).code != 0) {
    MESSAGE("no OpenCL device: left out");
    return;
  }
  const json usual = json::parse(content_of(folder / "r.json"));
  CHECK(usual["settings"]["tuned"] == false);

  const auto write_table = [&](const std::string& name) {
    json table = json::parse(R"({"format": "facet-tuning", "version": 2, "devices": [
      {"device": {}, "date": "2026-01-01T00:00:00Z",
       "values": {"layout": "narrow", "geometry": "image", "packets": false,
                  "packet_group": 4, "group": 64, "render_group": [8, 8], "trace_registers": 0,
                  "leaf_sure": 2, "leaf_size": 4}}]})");
    for (const char* key : {"name", "platform", "driver"})
      table["devices"][0]["device"][key] = usual["device"][key];
    if (!name.empty()) table["devices"][0]["device"]["name"] = name;
    put(folder / "t.json", table.dump());
  };
  write_table("");
  REQUIRE(bench(folder, {"--tuning", (folder / "t.json").string()}).code == 0);
  const json tuned = json::parse(content_of(folder / "r.json"));
  CHECK(tuned["settings"]["tuned"] == true);
  CHECK(tuned["results"][0]["layout"] == "narrow");
  CHECK(tuned["results"][0]["geometry"] == "image");
  CHECK(usual["results"][0]["geometry"] == "buffer");

  write_table("another");
  const outcome none = bench(folder, {"--tuning", (folder / "t.json").string()});
  CHECK(none.code != 0);
  CHECK(contains(none.err, "has nothing for"));
}
