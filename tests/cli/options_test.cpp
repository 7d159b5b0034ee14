// What the command line refuses, and that it says what is allowed.
#include <doctest/doctest.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;

namespace {

/// Runs `facet render SCENE -o out.npy` with more arguments, which must be refused as usage.
std::string refused(std::vector<std::string> more) {
  const temporary_folder folder;
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{"render", (folder / "s.json").string(), "-o",
                                 (folder / "out.npy").string()};
  words.insert(words.end(), more.begin(), more.end());
  const outcome o = run(words, without_devices());
  CHECK(o.code == 2);
  CHECK(o.out == "");
  CHECK(o.err.rfind("facet: ", 0) == 0);
  CHECK(folder.names() == std::vector<std::string>{"s.json"});
  return o.err;
}

}  // namespace

TEST_CASE("without a command, or with one that is not there, the program says which there are") {
  CHECK(run({}).code == 2);
  const outcome o = run({"rendr"});
  CHECK(o.code == 2);
  CHECK(contains(o.err, "\"rendr\""));
  CHECK(contains(o.err, "did you mean \"render\""));
}

TEST_CASE("--version and --help are no errors, and help names every command and exit code") {
  const outcome version = run({"--version"});
  CHECK(version.code == 0);
  CHECK(version.out.rfind("facet ", 0) == 0);
  const outcome help = run({"--help"});
  CHECK(help.code == 0);
  for (const char* word :
       {"render", "trace", "devices", "info", "compare", "sweep", "130 interrupted"})
    CHECK(contains(help.out, word));
}

TEST_CASE("each option of render is documented with its unit or default") {
  const outcome help = run({"render", "--help"});
  CHECK(help.code == 0);
  for (const char* word :
       {"--output", "--device", "--width", "--height", "--max-depth", "--work-group", "--geometry",
        "--tree", "--transfer", "--tile-size", "--all-features", "--kernels", "--stats", "--quiet",
        "Pixels", "default srgb", "50 ms"})
    CHECK(contains(help.out, word));
}

TEST_CASE("an image of size 0, or beyond the limit, is refused with the limit") {
  for (const char* value : {"0", "32769", "-5", "99999999999999999999"}) {
    const std::string message = refused({"--width", value});
    CHECK(contains(message, value));
    CHECK(contains(message, "from 1 to 32768 pixels"));
  }
  CHECK(contains(refused({"--height", "0"}), "from 1 to 32768 pixels"));
}

TEST_CASE("a side that follows from the aspect ratio obeys the limit, too") {
  // The scene is 48x32.
  const std::string message = refused({"--height", "32000", "--device", "serial"});
  CHECK(contains(message, "width would be 48000 pixels"));
  CHECK(contains(message, "at most 32768"));
}

TEST_CASE("work-groups and tiles are two whole numbers") {
  for (const char* value : {"8", "x8", "8x8x8"})
    CHECK(contains(refused({"--work-group", value}), "WIDTHxHEIGHT"));
  CHECK(contains(refused({"--tile-size", "0x0"}), "WIDTHxHEIGHT"));
}

TEST_CASE("a bounce limit beyond the scene model's is refused") {
  CHECK(contains(refused({"--max-depth", "65"}), "from 0 to 64 bounces"));
}

TEST_CASE("choices name what is allowed") {
  CHECK(contains(refused({"--tree", "oak"}), "found \"oak\"; allowed: binned|levels|none"));
  CHECK(contains(refused({"--geometry", "texture"}), "auto|buffer|image"));
  CHECK(contains(refused({"--transfer", "gamma"}), "linear|srgb"));
}

TEST_CASE("unknown options are named") { CHECK(contains(refused({"--colour"}), "--colour")); }

TEST_CASE("what means nothing to the serial tracer is refused, not ignored") {
  CHECK(contains(refused({"--device", "serial", "--work-group", "8x8"}), "--work-group"));
  CHECK(contains(refused({"--device", "serial-double", "--tree", "none"}), "--tree"));
}
