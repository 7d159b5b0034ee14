// Whole pictures of several widths and depths, as a user measures them.
#include <doctest/doctest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

const std::string knot = FACET_SOURCE_DIR "/scenes/knot.json";  // 1280x720 pixels, depth 3

bool is_without_devices() {
  return contains(run({"render", knot, "--width", "8", "--repeat", "1"}).err, "no OpenCL device");
}

}  // namespace

TEST_CASE("each width is measured at each depth, once, by each way") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const std::string path = (folder / "out.json").string();
  const outcome o = run({"render", knot, "--width", "64", "32", "64", "--depth", "0", "2", "-1",
                         "3", "--way", "default", "single", "--repeat", "2", "--json", path});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(std::ifstream(path));
  CHECK(file["format"] == "facet-bench-render");
  std::set<std::tuple<std::string, int, int>> found;
  std::map<std::pair<int, int>, json> rays;  // by width and depth
  for (const json& r : file["results"]) {
    const int width = r["width"], height = r["height"], depth = r["max_depth"];
    CHECK(found.emplace(r["way"], width, depth).second);
    CHECK(height == width * 9 / 16);
    for (const char* time : {"kernel_ms", "wall_ms"}) {
      CHECK(r[time]["all"].size() == 2);
      CHECK(r[time]["least"] > 0);
    }
    CHECK(r["tiles"] == 1);
    CHECK(r["pixels_that_differ"] == 0);
    CHECK(r["rays"]["eye"] == width * height);
    CHECK((r["rays"]["bounced"] == 0) == (depth == 0));
    rays[{width, depth}] = r["rays"];
  }
  CHECK(found.size() == 2 * 2 * 3);
  for (const int depth : {0, 2, 3}) {
    CAPTURE(depth);
    CHECK(rays.contains({32, depth}));
    CHECK(rays.contains({64, depth}));
  }
  CHECK(rays[{64, 3}]["bounced"] > rays[{64, 2}]["bounced"]);
  CHECK(rays[{64, 2}]["bounced"] > rays[{32, 2}]["bounced"]);
}

TEST_CASE("what cannot be a width or a depth is named, and nothing is written") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const auto refused = [&](const char* option, const char* value, const char* part) {
    const outcome o = run({"render", knot, option, "8", value, "--repeat", "1", "--json",
                           (folder / "out.json").string()});
    CAPTURE(o.err);
    CHECK(o.code != 0);
    CHECK(contains(o.err, part));
  };
  refused("--width", "40000", "40000x22500 was asked for; each side may be 1 to 32768");
  refused("--width", "wide", "--width");
  refused("--depth", "1.5", "--depth");
  CHECK(folder.names().empty());
}
