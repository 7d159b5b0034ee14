// Scenes that are wrong: what is said, exit code 3, and no output left behind.
#include <doctest/doctest.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// Renders a scene of that name and content; it must be refused as a scene, with every part.
void refused(const std::string& name, const std::string& content,
             const std::vector<std::string>& parts) {
  const temporary_folder folder;
  put(folder / name, content);
  put(folder / "out.npy", "old");
  const outcome o = run({"render", (folder / name).string(), "-o", (folder / "out.npy").string(),
                         "--device", "serial"},
                        without_devices());
  CAPTURE(o.err);
  CHECK(o.code == 3);
  CHECK(o.out == "");
  CHECK(o.err.rfind("facet: ", 0) == 0);
  CHECK(contains(o.err, name));
  for (const std::string& part : parts) {
    CAPTURE(part);
    CHECK(contains(o.err, part));
  }
  CHECK(content_of(folder / "out.npy") == "old");
  CHECK(folder.names().size() == 2);
}

std::string with(std::string scene, const std::string& from, const std::string& to) {
  const std::size_t at = scene.find(from);
  REQUIRE(at != std::string::npos);
  return scene.replace(at, from.size(), to);
}

}  // namespace

TEST_CASE("a file that is not there") {
  const temporary_folder folder;
  for (const char* name : {"none.json", "none.obj", "none.ply"}) {
    const outcome o = run({"render", (folder / name).string(), "-o", (folder / "out.npy").string(),
                           "--device", "serial"},
                          without_devices());
    CHECK(o.code == 3);
    CHECK(contains(o.err, (folder / name).string()));
  }
  CHECK(folder.names().empty());
}

TEST_CASE("an extension that no reader knows: those that are known") {
  refused("scene.stl", "solid", {".json", ".obj", ".ply"});
}

TEST_CASE("JSON that ends early: line and column") {
  refused("s.json", small_scene().substr(0, 200), {"line ", "column "});
}

TEST_CASE("a value of the wrong type: its place, what was found, what is allowed") {
  refused("s.json", with(small_scene(), "\"max_depth\": 3", "\"max_depth\": \"three\""),
          {"/picture/max_depth", "three"});
}

TEST_CASE("an unknown key: the nearest known one") {
  refused("s.json", with(small_scene(), "\"vertical_fov\"", "\"vertical_fow\""),
          {"/camera", "vertical_fow", "\"vertical_fov\""});
}

TEST_CASE("a material that is not there: the nearest known one") {
  refused("s.json", with(small_scene(), "\"material\": \"mirror\"", "\"material\": \"miror\""),
          {"miror", "\"mirror\""});
}

TEST_CASE("a camera that looks nowhere") {
  refused("s.json", with(small_scene(), "\"look_at\": [0, 0.5, 0]", "\"look_at\": [0, 1, 4]"),
          {"/camera", "look_at"});
}

TEST_CASE("a picture of no size, or beyond the limit") {
  refused("s.json", with(small_scene(), "\"width\": 48", "\"width\": 0"),
          {"/picture/width", "32768"});
  refused("s.json", with(small_scene(), "\"width\": 48", "\"width\": 40000"),
          {"/picture/width", "40000", "32768"});
}

TEST_CASE("an index out of range in a face, positive or negative: its line") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  refused("m.obj", vertices + "f 1 2 3\nf 1 2 9\n", {"line 5", "9", "3"});
  refused("m.obj", vertices + "f -1 -2 -4\n", {"line 4", "-4", "3"});
}

TEST_CASE("a mesh whose coordinates are all NaN or infinite has nothing to show") {
  refused("m.obj", "v nan 0 0\nv 1 inf 0\nv 0 1 -inf\nf 1 2 3\n", {"no usable triangle", "line 1"});
}

TEST_CASE("an empty mesh has nothing to show") {
  refused("m.obj", "# nothing\n", {"no "});
  refused("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", {"no "});
}

TEST_CASE("some coordinates that are NaN: their triangles are dropped, and the program says so") {
  const temporary_folder folder;
  put(folder / "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 1 0\nf 1 2 3\nf 1 2 4\n");
  const outcome o = run({"render", (folder / "m.obj").string(), "-o", (folder / "out.npy").string(),
                         "--device", "serial", "--width", "16"},
                        without_devices());
  CHECK(o.code == 0);
  CHECK(contains(o.err, "note: "));
  CHECK(contains(o.err, "1 triangle"));
  CHECK(folder.names().size() == 2);
}

TEST_CASE("a picture with NaN is not written: exit code 7") {
  // The floor is seen in a mirror that leaves no green; its light overflows to infinity, and
  // 0 * infinity is NaN.
  const temporary_folder folder;
  std::string scene = small_scene();
  scene = with(scene, "\"Kd\": 0.1, \"Kr\": 0.8", "\"Kd\": 0, \"Kr\": [1, 0, 1]");
  scene = with(scene, "\"Kd\": [0.8, 0.1, 0.1]", "\"Kd\": [1e38, 1e38, 1e38]");
  scene = with(scene, "\"colour\": 0.9", "\"colour\": 1e38");
  put(folder / "s.json", scene);
  put(folder / "out.npy", "old");
  const outcome o = run({"render", (folder / "s.json").string(), "-o",
                         (folder / "out.npy").string(), "--device", "serial"},
                        without_devices());
  CHECK(o.code == 7);
  CHECK(contains(o.err, "the picture holds NaN in "));
  CHECK(content_of(folder / "out.npy") == "old");
  CHECK(folder.names().size() == 2);
}
