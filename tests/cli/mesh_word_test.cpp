// Generators by a word: `facet trace terrain:10`.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// Triangles of the mesh that a word stands for; -1, and the message, if it is refused.
int triangles_of(const std::string& word, std::string* message = nullptr) {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", {});
  const outcome o = run({"trace", word, "--rays", (folder / "rays.npy").string(), "--hits",
                         (folder / "hits.npy").string(), "--stats", (folder / "s.json").string(),
                         "--device", "serial"},
                        without_devices());
  if (message) *message = o.err;
  if (o.code != 0) {
    CHECK(o.code == 3);
    CHECK(folder.names() == std::vector<std::string>{"rays.npy"});
    return -1;
  }
  return nlohmann::json::parse(content_of(folder / "s.json"))["triangles"];
}

}  // namespace

TEST_CASE("a bare number is the size: n, subdivisions or depth") {
  CHECK(triangles_of("terrain:10") == 200);  // 2 n^2
  CHECK(triangles_of("soup:77") == 77);
  CHECK(triangles_of("icosphere:2") == 320);  // 20 * 4^2
}

TEST_CASE("parameters have names, too") {
  CHECK(triangles_of("icosphere:radius=3,subdivisions=1") == 80);
}

TEST_CASE("an unknown kind or parameter: the nearest known one") {
  std::string message;
  CHECK(triangles_of("terain:10", &message) == -1);
  CHECK(contains(message, "\"terrain\""));
  CHECK(triangles_of("icosphere:subdivision=1", &message) == -1);
  CHECK(contains(message, "\"subdivisions\""));
}

TEST_CASE("a number that is none, and one beyond the limit") {
  std::string message;
  CHECK(triangles_of("terrain:many", &message) == -1);
  CHECK(contains(message, "\"many\", a number is needed"));
  CHECK(triangles_of("terrain:99999999", &message) == -1);
  CHECK(triangles_of("terrain:10,n=20", &message) == -1);
  CHECK(contains(message, "is given twice"));
}
