#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"
#include "scene/schema_helper.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

/// The file, which must be as the published schema has it.
json trees_in(const temporary_folder& folder) {
  json file = json::parse(content_of(folder / "trees.json"));
  const json schema = json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-trees.schema.json"));
  CHECK(schema_fault(file, schema) == "");
  return file;
}

}  // namespace

TEST_CASE("info counts triangles, instances and lights, and names what materials need") {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  const outcome o = run({"info", (folder / "s.json").string()}, without_devices());
  CHECK(o.code == 0);
  CHECK(o.err == "");
  CHECK(contains(o.out, "picture     48x32, depth 3, 1 sample a pixel"));
  CHECK(contains(o.out, "instances   2"));
  CHECK(contains(o.out, "traced      as one mesh of "));
  CHECK(contains(o.out, "lights      1"));
  CHECK(contains(o.out, "reflection"));
  CHECK(contains(o.out, "320 triangles, smooth"));  // 20 * 4^2
  CHECK(contains(o.out, "mirror           reflection"));
  CHECK(contains(o.out, "bounds      (-3, "));
}

TEST_CASE("info tells what the reader made up") {
  const temporary_folder folder;
  put(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const outcome o = run({"info", (folder / "m.obj").string()}, without_devices());
  CHECK(o.code == 0);
  CHECK(contains(o.out, "notes\n"));
  CHECK(contains(o.out, "camera"));
}

TEST_CASE("info of what is no scene is exit code 3") {
  CHECK(run({"info", "/nonexistent/scene.json"}, without_devices()).code == 3);
}

TEST_CASE("info --tree measures the trees of each builder, beside the full sweep's") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  for (const char* layout : {"narrow", "wide"}) {
    const outcome o =
        run({"info", (folder / "s.json").string(), "--tree", "levels,sah,sweep", "--layout", layout,
             "--samples", "100", "--device", "0", "--json", (folder / "trees.json").string()});
    CAPTURE(o.err);
    REQUIRE(o.code == 0);
    CHECK(contains(o.out, "320 triangles; the full sweep's costs: binary "));
    const json file = trees_in(folder);
    REQUIRE(file["builders"].size() == 3);
    const json& meshes = file["scene"]["meshes"];
    for (std::size_t b = 0; b < 3; ++b) {
      const json& builder = file["builders"][b];
      CHECK(builder["builder"] == json({"levels", "sah", "sweep"})[b]);
      CHECK(builder["layout"] == layout);
      CHECK(builder["top"]["primitives"] == 2);
      REQUIRE(builder["meshes"].size() == meshes.size());
      for (std::size_t k = 0; k < meshes.size(); ++k) {
        const json& tree = builder["meshes"][k];
        CHECK(tree["primitives"] == meshes[k]["triangles"]);
        CHECK(tree["end_point_overlap"]["sampled"] == (meshes[k]["triangles"] > 100));
        if (builder["builder"] != "sweep") continue;
        CHECK(tree["sah_cost_over_sweep"] == 1);
        CHECK(tree["binary"]["sah_cost_over_sweep"] == 1);
      }
    }
  }
}

TEST_CASE("info --tree refuses builders that are not there, and options that mean nothing") {
  const auto refused = [](std::vector<std::string> words, const char* part) {
    words.insert(words.begin(), {"info", "box"});
    const outcome o = run(words);
    CAPTURE(o.err);
    CHECK(o.code == 2);
    CHECK(contains(o.err, part));
  };
  refused({"--tree", "levels,best"}, "found \"best\"; allowed: levels, binned, sah, sweep");
  refused({"--tree", "sweep", "--samples", "1"}, "whole numbers from 2");
  refused({"--json", "x.json"}, "--json has no meaning without --tree levels|binned|sah|sweep");
}
