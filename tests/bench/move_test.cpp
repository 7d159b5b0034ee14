// Scenes that move, as a user measures them.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
using nlohmann::json;

namespace {

json measured(const temporary_folder& folder, const std::string& layout) {
  const outcome o =
      run({"move", "--mesh", "terrain:5", "--amplitude", "0", "0.5", "--instances", "1", "9",
           "--repeat", "2", "--layout", layout, "--json", (folder / "out.json").string()});
  if (contains(o.err, "no OpenCL device")) return nullptr;
  CAPTURE(o.err);
  REQUIRE(o.code == 0);
  return json::parse(content_of(folder / "out.json"));
}

}  // namespace

TEST_CASE("each move has its times and what the moved tree is worth beside the one made anew") {
  for (const std::string layout : {"narrow", "wide"}) {
    const temporary_folder folder;
    const json file = measured(folder, layout);
    if (file.is_null()) return;
    CHECK(file["format"] == "facet-bench-move");
    REQUIRE(file["results"].size() == 2);
    const json &still = file["results"][0], &waved = file["results"][1];
    for (const json& r : file["results"]) {
      CHECK(r["mesh"] == "terrain:5");
      CHECK(r["triangles"] == 50);
      CHECK(r["layout"] == layout);
      for (const char* side : {"move", "anew"}) {
        CHECK(r[side]["ms"]["samples"].size() == 2);
        CHECK(r[side]["build_ms"]["least"] > 0);
        CHECK(r[side]["build_ms"]["most"] <= r[side]["ms"]["most"]);
      }
      CHECK(r["bounce"]["rays"] > 0);
      CHECK(r["primary"]["ratio"]["samples"].size() == 2);
    }
    // Where nothing has moved the trees are one; waves stretch the boxes of the tree that stays.
    CHECK(still["sah_cost"]["moved"] == still["sah_cost"]["anew"]);
    CHECK(waved["sah_cost"]["moved"] != still["sah_cost"]["moved"]);
    REQUIRE(file["instances"].size() == 2);
    CHECK(file["instances"][1]["instances"] == 9);
    CHECK(file["instances"][1]["move"]["ms"]["median"] > 0);
  }
}

TEST_CASE("a builder whose trees are the reference's is refused") {
  CHECK(run({"move", "--tree", "sweep"}).code != 0);
}
