// Time against triangles, as a user measures it.
#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"
#include "scene/schema_helper.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

outcome growth(const temporary_folder& folder, std::vector<std::string> more,
               const surroundings& s = {}) {
  std::vector<std::string> words{"growth",  "--json",   (folder / "out.json").string(),
                                 "--width", "64",       "--repeat",
                                 "3",       "--builds", "2"};
  words.insert(words.end(), more.begin(), more.end());
  return run(words, s);
}

/// The file, which must be as the published schema has it.
json result_in(const temporary_folder& folder) {
  json file = json::parse(content_of(folder / "out.json"));
  const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-growth.schema.json"));
  CHECK(schema_fault(file, schema) == "");
  return file;
}

bool is_without_devices() {
  return contains(run({"growth", "--triangles", "2", "--width", "64"}, {}).err, "no OpenCL device");
}

}  // namespace

TEST_CASE("each way is measured at each size, and all find the same hits") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const outcome o = growth(folder, {"--triangles", "1e2", "1e1", "100"});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  for (const char* part : {"64x36 eye rays", "terrain:7", "soup:100", "no-tree", "serial"})
    CHECK(contains(o.out, part));
  const json file = result_in(folder);
  CHECK(file["complete"] == true);
  CHECK(file["settings"]["triangles"] == json({10, 100}));
  REQUIRE(file["families"].size() == 2);
  for (const json& family : file["families"])
    for (const json& series : family["series"]) {
      CHECK(series["ended"].is_null());
      REQUIRE(series["points"].size() == 2);
      for (const json& p : series["points"]) {
        const bool has_tree = series["way"] == "tree", is_serial = series["way"] == "serial";
        CHECK(p["build"]["samples_ms"].size() == (is_serial ? 1 : 2));
        REQUIRE(p["figures"].size() == (has_tree ? 3 : 1));
        CHECK(p["figures"][0]["count"] == 64 * 36);
        CHECK(p["figures"][0]["time"]["samples_ms"].size() == 3);
        if (has_tree)
          CHECK(!p["figures"][0].contains("differing_hits"));
        else
          CHECK(p["figures"][0]["differing_hits"] == 0);
      }
    }
  CHECK(file["families"][0]["series"][0]["points"][1]["triangles"] == 98);
}

TEST_CASE("a figure beyond the budget ends its series with a reason, the tree's goes on") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const outcome o =
      growth(folder, {"--mesh", "soup", "--triangles", "10", "20", "--budget", "1e-9"});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  CHECK(contains(o.out, "no-tree  ends before 10 triangles: it would take about "));
  const json family = result_in(folder)["families"][0];
  CHECK(family["series"][0]["points"].size() == 2);
  for (const int k : {1, 2}) {
    CHECK(family["series"][k]["points"].empty());
    CHECK(family["series"][k]["ended"]["triangles"] == 10);
  }
}

// PoCL takes its device's memory from POCL_MEMORY_LIMIT, in GiB; 6 million triangles need more, and
// in one buffer more than it gives.
TEST_CASE("a mesh that does not fit the device ends its series with the reason") {
  const surroundings small{{"POCL_MEMORY_LIMIT=1"}, 0, false};
  if (is_without_devices() || is_sanitized()) return;
  const temporary_folder folder;
  const outcome o = growth(
      folder,
      {"--mesh", "soup", "--triangles", "10", "6e6", "--budget", "1e-9", "--device", "pthread"},
      small);
  if (o.code == 1 && contains(o.err, "pthread")) return;  // no PoCL here
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json tree = result_in(folder)["families"][0]["series"][0];
  CHECK(tree["points"].size() == 1);
  CHECK(tree["ended"]["triangles"] == 6000000);
  CHECK(contains(tree["ended"]["reason"].get<std::string>(),
                 "a buffer of 288000000 bytes does not fit"));
  CHECK(contains(o.out, "in one allocation"));
}

TEST_CASE("what cannot be measured is named, with what can, and nothing is written") {
  const temporary_folder folder;
  const auto refused = [&](std::vector<std::string> words, const char* part) {
    words.insert(words.begin(), {"growth", "--json", (folder / "out.json").string()});
    const outcome o = run(words);
    CAPTURE(o.err);
    CHECK(o.code != 0);
    CHECK(contains(o.err, part));
  };
  refused({"--triangles", "1.5"}, "found 1.5; allowed are whole numbers");
  refused({"--triangles", "1"}, "from 2 to 134217728");
  refused({"--triangles", "10", "--width", "100"}, "multiples of 64");
  refused({"--mesh", "bunny"}, "bunny not in {terrain,soup}");
  CHECK(folder.names().empty());
}
