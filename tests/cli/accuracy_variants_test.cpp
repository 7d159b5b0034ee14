// Speed against error as a user runs it.
#include <doctest/doctest.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"
#include "scene/schema_helper.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

const char* knot = R"({
  "camera": {"position": [0, 0, 4]},
  "picture": {"width": 24, "height": 16, "max_depth": 1},
  "meshes": {"knot": {"generate": "torus_knot", "segments": 24, "sides": 5}},
  "instances": [{"mesh": "knot"}],
  "lights": [{"type": "directional", "direction": [0, -1, -1]}]
})";

outcome variants(const temporary_folder& folder, std::vector<std::string> more) {
  put(folder / "knot.json", knot);
  std::vector<std::string> words{"accuracy", "--variants", (folder / "knot.json").string(),
                                 "--json", (folder / "out.json").string()};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

/// The file, which must be as the published schema has it.
json result_in(const temporary_folder& folder) {
  json file = json::parse(content_of(folder / "out.json"));
  const json schema =
      json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-variants.schema.json"));
  CHECK(schema_fault(file, schema) == "");
  return file;
}

/// Refused as usage, with this in the message, before anything is written.
void refused(std::vector<std::string> more, const std::string& part) {
  const temporary_folder folder;
  const outcome o = variants(folder, std::move(more));
  CAPTURE(o.err);
  CHECK(o.code == 2);
  CHECK(contains(o.err, part));
  CHECK(folder.names() == std::vector<std::string>{"knot.json"});
}

}  // namespace

TEST_CASE("variants are measured, told of in a table and written; strict is always among them") {
  if (!has_device()) return;
  const temporary_folder folder;
  const outcome o = variants(
      folder, {"--only", "no-tree,depth-0", "--size", "24x16", "--repeats", "3", "--seed", "7"});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  for (const char* part : {"knot, 240 triangles, 24x16, 1 x 1 samples a pixel, depth 1; 384 eye",
                           "strict ", "no-tree ", "depth-0 ", "Wrong hits per million"})
    CHECK(contains(o.out, part));
  CHECK(contains(o.err, "facet: wrote "));

  const json file = result_in(folder);
  CHECK(file["complete"] == true);
  CHECK(file["settings"]["seed"] == 7);
  CHECK(file["order"].size() == 3 * 3);
  const json& all = file["variants"];
  REQUIRE(all.size() == 3);
  CHECK(all[0]["name"] == "strict");
  CHECK(all[1]["name"] == "no-tree");
  CHECK(all[1]["tree"]["kind"] == "none");
  CHECK(all[2]["hits_of"] == "strict");
  for (const json& v : all) {
    CHECK(v["state"] == "measured");
    CHECK(v["picture"]["kernel"]["samples_ms"].size() == 3);
    CHECK(v["picture"]["errors"]["displayed"]["flip_mean"].get<double>() < 0.01);
    CHECK(v["hits"][0]["errors"]["errors"] == 0);
  }
  CHECK(all[1]["hits"][0]["errors"]["other_bits_than_strict"] == 0);
  CHECK(all[1]["picture"]["errors"]["other_bits_than_strict"] == 0);
}

// 81,920 triangles and 307,200 eye rays are too many for any device's budget.
TEST_CASE(
    "without a tree a large scene is left out, and said so; interrupted at once, nothing is kept") {
  if (!has_device()) return;
  const temporary_folder folder;
  program p({"accuracy", "--variants", "icosphere:6", "--json", (folder / "out.json").string(),
             "--size", "640x480", "--repeats", "1"});
  REQUIRE(p.wait_for("no-tree is left out: 81920 triangles are too many"));
  p.send(SIGINT);
  const outcome o = p.wait();
  CAPTURE(o.err);
  CHECK(o.code == 130);
  CHECK(contains(o.err, "--only no-tree runs it"));
  CHECK(folder.names().empty());
}

TEST_CASE("interrupted, it keeps what it has, marked as not complete: exit code 130") {
  if (!has_device()) return;
  if (!has_terminal()) return;
  const temporary_folder folder;
  const std::vector<std::string> small{"--only", "depth-0", "--size", "24x16", "--repeats"};
  // Drivers keep what they compiled: 1% of the time is then far more than warming up takes.
  std::vector<std::string> words = small;
  words.push_back("1");
  REQUIRE(variants(folder, words).code == 0);
  std::filesystem::remove(folder / "out.json");
  words = {"accuracy", "--variants", (folder / "knot.json").string(), "--json",
           (folder / "out.json").string()};
  words.insert(words.end(), small.begin(), small.end());
  words.push_back("50000");
  surroundings s;
  s.terminal = true;
  program p(words, s);
  REQUIRE(p.wait_for("1%, about "));
  p.send(SIGINT);
  const outcome o = p.wait();
  CAPTURE(o.err);
  CHECK(o.code == 130);
  CHECK(contains(o.err, "facet: interrupted at "));
  CHECK(contains(o.err, "out.json holds what was found, marked as not complete"));
  CHECK(contains(o.out, "strict "));
  const json file = result_in(folder);
  CHECK(file["complete"] == false);
  CHECK(file["variants"][0]["state"] == "unfinished");
  CHECK(file["variants"][0]["picture"]["kernel"]["summary"]["median_ms"].get<double>() > 0);
  CHECK(folder.names() == std::vector<std::string>{"knot.json", "out.json"});
}

TEST_CASE("what cannot be measured is named, with what can") {
  refused({"--cases", "all"}, "--cases has no meaning with --variants");
  refused({"--mistakes"}, "--mistakes has no meaning with --variants");
  refused({"--only", "fast-maths"}, "did you mean \"fast-math\"");
  refused({"--only", "depth-1"}, "depth-0");
  refused({"--repeats", "0"}, "from 1 to 100000 times");
  refused({"--size", "24"}, "WIDTHxHEIGHT");
  refused({"--size", "32768x32768"}, "eye rays; at most");
  refused({"--device", "serial"}, "held against the double reference");
  refused({"--seed", "4294967296"}, "at most 4294967295");
}

TEST_CASE("options of the variants mean nothing to the cases") {
  for (const char* option : {"--only", "--repeats"}) {
    const outcome o = run({"accuracy", "--cases", "2", option, "1"});
    CHECK(o.code == 2);
    CHECK(contains(o.err, "without --variants SCENE"));
  }
}

TEST_CASE("a scene that is not there is named; the scene is not overwritten") {
  const temporary_folder folder;
  const outcome o = run({"accuracy", "--variants", (folder / "none.json").string()});
  CHECK(o.code == 3);
  CHECK(contains(o.err, "none.json"));
  put(folder / "knot.json", knot);
  const std::string scene = (folder / "knot.json").string();
  CHECK(run({"accuracy", "--variants", scene, "--json", scene}).code == 2);
  CHECK(content_of(folder / "knot.json") == knot);
}
