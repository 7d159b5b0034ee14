// Building trees, as a user measures it.
#include <doctest/doctest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

bool is_without_devices() {
  return contains(run({"build", "--mesh", "soup:2", "--repeat", "1"}).err, "no OpenCL device");
}

}  // namespace

TEST_CASE("each builder's times are there, with rates that follow, and costs if asked for") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const outcome o =
      run({"build", "--mesh", "terrain:5", "soup:40", "--repeat", "3", "--no-peers", "--tree",
           "levels", "--layout", "narrow", "--quality", "--json", (folder / "out.json").string()});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(content_of(folder / "out.json"));
  CHECK(file["format"] == "facet-bench-build");
  CHECK(file["peer"].is_null());
  CHECK(file["refused"].empty());
  REQUIRE(file["results"].size() == 2);
  for (const json& r : file["results"]) {
    CAPTURE(r.dump());
    CHECK(r["builder"] == "levels");
    CHECK(r["layout"] == "narrow");
    CHECK(r["triangles"] == (r["mesh"] == "terrain:5" ? 50 : 40));
    REQUIRE(r["build"]["seconds"].size() == 3);
    const double rate = r["build"]["mtriangles_per_s_most"];
    const auto seconds = r["build"]["seconds"].get<std::vector<double>>();
    const double least = *std::min_element(seconds.begin(), seconds.end());
    // A quotient and two products in double.
    CHECK(rate * least * 1e6 == doctest::Approx(r["triangles"].get<double>()).epsilon(1e-14));
    CHECK(!r.contains("ratios"));
    CHECK(r["quality"]["binary_sah_cost"] > 1);
    CHECK(contains(o.out, r["mesh"].get<std::string>()));
  }
}

TEST_CASE("beside Embree each has a ratio, turn by turn") {
  if (is_without_devices()) return;
  const temporary_folder folder;
  const outcome o = run({"build", "--mesh", "soup:300", "--repeat", "1", "--threads", "1", "--json",
                         (folder / "out.json").string()});
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(content_of(folder / "out.json"));
  if (file["peer"].is_null()) {
    CHECK(contains(o.out, "built without Embree"));
    return;
  }
  REQUIRE(file["results"].size() == 4);
  const json& ours = file["results"][0];
  for (std::size_t k = 2; k < 4; ++k) {
    const json& peer = file["results"][k];
    const double of = double(peer["build"]["seconds"][0]) / double(ours["build"]["seconds"][0]);
    CHECK(ours["ratios"][peer["builder"].get<std::string>()]["median"] == of);
    CHECK(!peer.contains("quality"));
  }
}

// PoCL takes its device's memory from POCL_MEMORY_LIMIT, in GiB; 6 million triangles need more.
TEST_CASE("a mesh that does not fit is told of, and the others are measured") {
  const surroundings small{{"POCL_MEMORY_LIMIT=1"}, 0, false};
  if (is_without_devices() || is_sanitized()) return;
  const temporary_folder folder;
  const outcome o =
      run({"build", "--mesh", "soup:6e6", "soup:10", "--tree", "binned", "--repeat", "1",
           "--no-peers", "--device", "pthread", "--json", (folder / "out.json").string()},
          small);
  if (o.code == 1 && contains(o.err, "pthread")) return;  // no PoCL here
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  const json file = json::parse(content_of(folder / "out.json"));
  REQUIRE(file["refused"].size() == 1);
  CHECK(file["refused"][0]["mesh"] == "soup:6e6");
  CHECK(contains(file["refused"][0]["reason"], "a buffer of 288000000 bytes does not fit"));
  CHECK(file["results"].size() == 1);
}

TEST_CASE("builders that the device has not are refused with those that it has") {
  const outcome o = run({"build", "--tree", "sweep"});
  CHECK(o.code != 0);
  CHECK(contains(o.err, "sweep not in {levels,binned}"));
}
