// Ctrl-C in the middle of the work.
#include <doctest/doctest.h>

#include <cmath>
#include <csignal>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

const char* mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// Interrupts a render that would take seconds, once it said its first word.
void interrupts(int number, const std::vector<std::string>& device, const surroundings& s) {
  const temporary_folder folder;
  put(folder / "m.obj", mesh);
  put(folder / "out.npy", "old");
  std::vector<std::string> words{"render",   (folder / "m.obj").string(),
                                 "-o",       (folder / "out.npy").string(),
                                 "--width",  "4000",
                                 "--height", "4000"};
  words.insert(words.end(), device.begin(), device.end());
  program p(words, s);
  REQUIRE(p.wait_for("note: "));
  p.send(number);
  const outcome o = p.wait();
  CAPTURE(o.err);
  CHECK(o.code == 130);
  CHECK(contains(o.err, "facet: interrupted"));
  CHECK(contains(o.err, "nothing was saved"));
  CHECK(content_of(folder / "out.npy") == "old");
  CHECK(folder.names() == std::vector<std::string>{"m.obj", "out.npy"});
}

}  // namespace

TEST_CASE("Ctrl-C ends a serial render: exit code 130, the old file untouched") {
  interrupts(SIGINT, {"--device", "serial"}, without_devices());
}

TEST_CASE("SIGTERM does the same") {
  interrupts(SIGTERM, {"--device", "serial"}, without_devices());
}

TEST_CASE("Ctrl-C ends a render on a device") {
  if (has_device()) interrupts(SIGINT, {}, {});
}

TEST_CASE("Ctrl-C ends tracing") {
  const temporary_folder folder;
  std::vector<float> rays;
  for (int i = 0; i < 1000; ++i) rays.insert(rays.end(), {0, 0, 5, 0, 0, 0, -1, INFINITY});
  put_rays(folder / "rays.npy", rays);
  program p({"trace", "icosphere:3", "--rays", (folder / "rays.npy").string(), "--hits",
             (folder / "hits.npy").string(), "--repeat", "100000", "--tree", "none", "--device",
             "serial"},
            without_devices());
  REQUIRE(p.wait_until_handled(SIGINT, true));
  p.send(SIGINT);
  const outcome o = p.wait();
  CHECK(o.code == 130);
  CHECK(contains(o.err, "nothing was saved"));
  CHECK(folder.names() == std::vector<std::string>{"rays.npy"});
}

TEST_CASE("a second Ctrl-C ends the program at once, whatever it is doing") {
  const temporary_folder folder;
  put_rays(folder / "rays.npy", {0, 0, 5, 0, 0, 0, -1, INFINITY});
  // Making and sorting two million triangles looks at no flag for a second or so.
  program p({"trace", "soup:2000000", "--rays", (folder / "rays.npy").string(), "--hits",
             (folder / "hits.npy").string(), "--device", "serial"},
            without_devices());
  REQUIRE(p.wait_until_handled(SIGINT, true));
  p.send(SIGINT);
  REQUIRE(p.wait_until_handled(SIGINT, false));
  p.send(SIGINT);
  CHECK(p.wait().signal == SIGINT);
  CHECK(folder.names() == std::vector<std::string>{"rays.npy"});
}
