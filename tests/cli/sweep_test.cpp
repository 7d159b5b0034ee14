// The block-size study as a user runs it.
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

/// One mesh without glass or mirrors: drivers that compile for each shape do so fast.
const char* knot = R"({
  "camera": {"position": [0, 0, 4]},
  "picture": {"width": 24, "height": 16, "max_depth": 1},
  "meshes": {"knot": {"generate": "torus_knot", "segments": 24, "sides": 5}},
  "instances": [{"mesh": "knot"}],
  "lights": [{"type": "directional", "direction": [0, -1, -1]}]
})";

outcome sweep(const temporary_folder& folder, std::vector<std::string> more,
              const surroundings& s = {}) {
  put(folder / "knot.json", knot);
  std::vector<std::string> words{"sweep", (folder / "knot.json").string(), "--json",
                                 (folder / "out.json").string()};
  words.insert(words.end(), more.begin(), more.end());
  return run(words, s);
}

/// The file, which must be as the published schema has it.
json result_in(const temporary_folder& folder) {
  json file = json::parse(content_of(folder / "out.json"));
  const json schema = json::parse(std::ifstream(FACET_SOURCE_DIR "/bench/facet-sweep.schema.json"));
  CHECK(schema_fault(file, schema) == "");
  return file;
}

/// Refused as usage, with this in the message, before anything is written.
void refused(std::vector<std::string> more, const std::string& part) {
  const temporary_folder folder;
  const outcome o = sweep(folder, std::move(more));
  CAPTURE(o.err);
  CHECK(o.code == 2);
  CHECK(contains(o.err, part));
  CHECK(folder.names() == std::vector<std::string>{"knot.json"});
}

}  // namespace

TEST_CASE("a sweep writes every sample, and prints the best with their intervals") {
  if (!has_device()) return;
  const temporary_folder folder;
  const outcome o =
      sweep(folder, {"--shapes", "1x1,8x2,32768x2,driver", "--large", "terrain:4", "--width", "24",
                     "--repeats", "3", "--serial-repeats", "2", "--seed", "7"});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  for (const char* part : {"no-tree: knot, 240 triangles, tree none, 24x16", "tree: knot",
                           "large: terrain:4, 32 triangles", "serial", "best: ", " of 3 shapes",
                           "1x1", "driver", "refused: 1 of 4 shapes; 32768x2: kernel 'render'"})
    CHECK(contains(o.out, part));
  CHECK(contains(o.err, "facet: wrote "));

  const json file = result_in(folder);
  CHECK(file["complete"] == true);
  CHECK(file["settings"]["seed"] == 7);
  CHECK(file["settings"]["shapes"] == json({"1x1", "8x2", "32768x2", "driver"}));
  REQUIRE(file["experiments"].size() == 3);
  for (const json& e : file["experiments"]) {
    CHECK(e["picture"]["width"] == 24);
    CHECK(e["shapes"][0]["kernel"]["samples_ms"].size() == 3);
    CHECK(e["shapes"][2]["standing"] == "refused");
    CHECK(e["serial"]["wall"]["samples_ms"].size() == 2);
    CHECK(e["order"].size() == 3 * 3 + 2);
    CHECK(!e["best"].empty());
  }
  CHECK(file["experiments"][0]["scene"]["hash"] == file["experiments"][1]["scene"]["hash"]);
  CHECK(file["experiments"][0]["scene"]["hash"] != file["experiments"][2]["scene"]["hash"]);
}

// One wrong bit in one pixel, in work-groups of 8x2 alone.
TEST_CASE("a tampered kernel is caught: exit code 4, with shape, pixels and the first of them") {
  if (!has_device()) return;
  const temporary_folder folder;
  const std::filesystem::path kernels = folder / "cl";
  std::filesystem::copy(FACET_SOURCE_DIR "/cl", kernels);
  std::string text = content_of(kernels / "render.cl");
  const std::string from = "pixels[(size_t)y * view->width + x] =";
  REQUIRE(contains(text, from));
  text.replace(text.find(from), from.size(),
               "if (get_local_size(0) == 8 && get_local_size(1) == 2 && x == 5 && y == 3)\n"
               "    sum.y = as_float(as_uint(sum.y) ^ 1u);\n  " +
                   from);
  put(kernels / "render.cl", text);
  const outcome o =
      sweep(folder, {"--shapes", "1x1,8x2,2x8", "--experiments", "tree", "--width", "24",
                     "--repeats", "2", "--serial-repeats", "0", "--kernels", kernels.string()});
  CAPTURE(o.err);
  CHECK(o.code == 4);
  CHECK(contains(o.err,
                 "experiment tree, shape 8x2: 1 of 384 pixels differ from 1x1's, "
                 "the first at (5, 3)"));
  const json file = result_in(folder);
  CHECK(file["settings"]["kernels"] == "folder");
  const json& shapes = file["experiments"][0]["shapes"];
  CHECK(shapes[0]["standing"] == "measured");
  CHECK(shapes[1]["standing"] == "different");
  CHECK(shapes[1]["differing_pixels"] == 1);
  CHECK(shapes[1]["first_differing_pixel"] == json({5, 3}));
  CHECK(shapes[2]["standing"] == "measured");
}

TEST_CASE("interrupted, it keeps what it has, marked as not complete: exit code 130") {
  if (!has_device()) return;
  if (!has_terminal()) return;
  const temporary_folder folder;
  const std::vector<std::string> small{"--shapes", "1x1,8x2", "--experiments", "tree",
                                       "--width",  "24",      "--repeats"};
  // Drivers keep what they compiled: 1% of the time is then far more than warming up takes.
  std::vector<std::string> words = small;
  words.push_back("1");
  REQUIRE(sweep(folder, words).code == 0);
  std::filesystem::remove(folder / "out.json");
  words = {"sweep", (folder / "knot.json").string(), "--json", (folder / "out.json").string()};
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
  CHECK(contains(o.err, "out.json, marked as not complete"));
  const json file = result_in(folder);
  CHECK(file["complete"] == false);
  const json& e = file["experiments"][0];
  CHECK(e["complete"] == false);
  CHECK(e["best"].empty());
  CHECK(!e["order"].empty());
  CHECK(e["order"].size() < 100000);
  CHECK(e["shapes"][0]["standing"] == "unfinished");
  CHECK(e["shapes"][0]["kernel"]["summary"]["median_ms"].get<double>() > 0);
  CHECK(folder.names() == std::vector<std::string>{"knot.json", "out.json"});
}

TEST_CASE("interrupted before anything was measured, an earlier result stays as it was") {
  if (!has_device()) return;
  const temporary_folder folder;
  put(folder / "out.json", "old");
  program p({"sweep", "icosphere:6", "--json", (folder / "out.json").string(), "--experiments",
             "tree", "--shapes", "1x1"});
  REQUIRE(p.wait_until_handled(SIGINT, true));
  p.send(SIGINT);
  const outcome o = p.wait();
  CAPTURE(o.err);
  CHECK(o.code == 130);
  CHECK(content_of(folder / "out.json") == "old");
}

TEST_CASE(
    "a scene too large to be traced without a tree: left out and recorded, unless asked for") {
  if (!has_device()) return;
  const temporary_folder folder;
  const std::string out = (folder / "out.json").string();
  const outcome o = run({"sweep", "icosphere:5", "--json", out, "--large", "terrain:4", "--shapes",
                         "1x1", "--width", "96", "--repeats", "1", "--serial-repeats", "0"});
  CAPTURE(o.err);
  CHECK(o.code == 0);
  CHECK(contains(o.err, "no-tree is left out: 20480 triangles are too many"));
  const json file = result_in(folder);
  CHECK(file["experiments"].size() == 2);
  CHECK(file["left_out"][0]["experiment"] == "no-tree");

  const outcome asked =
      run({"sweep", "icosphere:5", "--json", out, "--experiments", "no-tree,tree"});
  CHECK(asked.code == 2);
  CHECK(contains(asked.err, "--brute-width"));
}

TEST_CASE("what cannot be swept is named, with what can") {
  refused({"--shapes", "8x8,oak"}, "found \"oak\"");
  refused({"--shapes", "0x8"}, "WIDTHxHEIGHT");
  refused({"--shapes", "8x8,8x8"}, "8x8 twice");
  refused({"--experiments", "tre"}, "did you mean \"tree\"");
  refused({"--repeats", "0"}, "from 1 to 100000 times");
  refused({"--device", "serial"}, "no work-groups to sweep");
}

TEST_CASE("the scene is not overwritten, and a folder that is not there is an error at once") {
  const temporary_folder folder;
  put(folder / "knot.json", knot);
  const std::string scene = (folder / "knot.json").string();
  CHECK(run({"sweep", scene, "--json", scene}).code == 2);
  CHECK(content_of(folder / "knot.json") == knot);
  CHECK(run({"sweep", scene, "--json", (folder / "none" / "out.json").string()}).code == 6);
}

TEST_CASE("without a device there is nothing to sweep") {
  const temporary_folder folder;
  CHECK(sweep(folder, {}, without_devices()).code == 4);
}
