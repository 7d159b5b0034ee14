#include <doctest/doctest.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

TEST_CASE("info counts triangles, instances and lights, and names what materials need") {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  const outcome o = run({"info", (folder / "s.json").string()}, without_devices());
  CHECK(o.code == 0);
  CHECK(o.err == "");
  CHECK(contains(o.out, "picture     48x32, depth 3, 1 sample a pixel"));
  CHECK(contains(o.out, "instances   2"));
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
