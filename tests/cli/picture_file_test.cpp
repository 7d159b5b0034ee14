// Where pictures cannot go: what is said, and that nothing is left or lost.
#include <doctest/doctest.h>
#include <unistd.h>

#include "cli/program_helper.hpp"
#include "image/temporary_folder.hpp"

using namespace facet::test;
namespace fs = std::filesystem;

namespace {

outcome render_to(const temporary_folder& folder, const fs::path& target,
                  std::vector<std::string> more = {}) {
  put(folder / "s.json", small_scene());
  std::vector<std::string> words{"render",   (folder / "s.json").string(),
                                 "-o",       target.string(),
                                 "--device", "serial",
                                 "--width",  "12"};
  words.insert(words.end(), more.begin(), more.end());
  return run(words, without_devices());
}

/// Is the program built with OpenImageIO?
bool writes_png() {
  static const bool found = [] {
    const temporary_folder folder;
    return render_to(folder, folder / "a.png").code == 0;
  }();
  return found;
}

}  // namespace

TEST_CASE("a folder that does not exist is named before any work is done") {
  const temporary_folder folder;
  const outcome o = render_to(folder, folder / "no" / "out.npy");
  CHECK(o.code == 6);
  CHECK(contains(o.err, (folder / "no").string()));
  CHECK(contains(o.err, "does not exist"));
  CHECK(folder.names() == std::vector<std::string>{"s.json"});
  // Before any work: the scene is not even read.
  CHECK(run({"render", (folder / "none.json").string(), "-o", (folder / "no" / "out.npy").string()},
            without_devices())
            .code == 6);
}

TEST_CASE("a folder is no picture") {
  const temporary_folder folder;
  fs::create_directory(folder / "out.npy");
  CHECK(render_to(folder, folder / "out.npy").code == 6);
}

TEST_CASE("an unknown extension is a usage error that names the known ones") {
  const temporary_folder folder;
  const outcome o = render_to(folder, folder / "out.jpeg");
  CHECK(o.code == 2);
  CHECK(contains(o.err, "\".jpeg\""));
  CHECK(contains(o.err, ".npy"));
  CHECK(contains(render_to(folder, folder / "out").err, "no extension"));
}

TEST_CASE("a full disk: exit code 6 and the reason, for every kind of file") {
  const temporary_folder folder;
  std::vector<std::string> names{"full.npy"};
  if (writes_png()) names.insert(names.end(), {"full.png", "full.exr"});
  for (const std::string& name : names) {
    fs::create_symlink("/dev/full", folder / name);
    const outcome o = render_to(folder, folder / name);
    CHECK(o.code == 6);
    CHECK(contains(o.err, "No space left on device"));
    CHECK(contains(o.err, name));
    fs::remove(folder / name);
  }
  CHECK(folder.names() == std::vector<std::string>{"s.json"});
}

TEST_CASE("a device without an extension does not say what it takes: exit code 6") {
  const temporary_folder folder;
  const outcome o = render_to(folder, "/dev/full");
  CHECK(o.code == 6);
  CHECK(contains(o.err, "/dev/full"));
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("a full disk under --stats is an output error, too") {
  const temporary_folder folder;
  const outcome o = render_to(folder, folder / "out.npy", {"--stats", "/dev/full"});
  CHECK(o.code == 6);
  CHECK(contains(o.err, "/dev/full: cannot be written: No space left on device"));
}

TEST_CASE("the picture and the statistics cannot be one file") {
  const temporary_folder folder;
  CHECK(render_to(folder, folder / "out.npy", {"--stats", (folder / "out.npy").string()}).code ==
        2);
}

TEST_CASE("PNG, EXR and .npy of one render hold the same picture") {
  if (!writes_png()) return;
  const temporary_folder folder;
  for (const char* name : {"a.npy", "a.exr", "a.png"})
    REQUIRE(render_to(folder, folder / name).code == 0);
  REQUIRE(render_to(folder, folder / "linear.png", {"--transfer", "linear"}).code == 0);
  const auto compared = [&](const char* name) {
    const outcome o = run({"compare", (folder / "a.npy").string(), (folder / name).string()});
    CHECK(o.code == 0);
    return o.out;
  };
  CHECK(contains(compared("a.exr"), "max error            0 at"));
  CHECK(contains(compared("a.png"), "displayed (sRGB)   0 pixels"));
  CHECK(contains(compared("linear.png"), "linear             0 pixels"));
}

TEST_CASE(
    "without its part for picture files the program says so before any work, and writes .npy") {
  if (!writes_png()) return;
  const temporary_folder folder;
  surroundings alone = without_devices();
  alone.program = (folder / "facet").string();
  fs::copy_file(FACET_PROGRAM, alone.program);
  put(folder / "s.json", small_scene());
  const auto render_alone = [&](const char* name) {
    return run({"render", (folder / "s.json").string(), "-o", (folder / name).string(), "--device",
                "serial", "--width", "12"},
               alone);
  };
  const outcome o = render_alone("a.png");
  CHECK(o.code == 6);
  CHECK(contains(o.err, (folder / "facet_pictures.so").string()));
  CHECK(contains(o.err, "install facet again"));
  CHECK(render_alone("a.npy").code == 0);
  CHECK(folder.names() == std::vector<std::string>{"a.npy", "facet", "s.json"});
  // One that is there, but is none.
  put(folder / "facet_pictures.so", "no module");
  const outcome damaged = render_alone("a.png");
  CHECK(damaged.code == 6);
  CHECK(contains(damaged.err, "cannot be loaded"));
}
