// Reading and writing through OpenImageIO: with the option off there is nothing to test.
#ifdef FACET_OPENIMAGEIO
#include "image/write.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "image/output.hpp"
#include "image/read.hpp"
#include "image/temporary_folder.hpp"
#include "scene/error.hpp"

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define FACET_LEAK_SANITIZER
#endif
#elif defined(__SANITIZE_ADDRESS__)
#define FACET_LEAK_SANITIZER
#endif
#ifdef FACET_LEAK_SANITIZER
#include <sanitizer/lsan_interface.h>
#endif

using namespace facet;
using image::transfer;
using test::temporary_folder;

namespace {

/// All four channels between -0.1 and 1.1, alpha and colour independent.
picture pattern(std::uint32_t width, std::uint32_t height) {
  picture p(width, height);
  std::uint32_t state = 1;
  for (float& v : p.rgba) {
    state = state * 1664525u + 1013904223u;
    v = float(state >> 8) * 0x1p-24f * 1.2f - 0.1f;
  }
  return p;
}

std::string message_of(const std::filesystem::path& path, const picture& p) {
  try {
    image::write_picture(path, p);
  } catch (const image::output_error& e) {
    return e.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// libpng leaves OpenImageIO's callback by longjmp when a file ends early, over a string's
/// destructor: that leak is theirs.
struct leaks_allowed {
#ifdef FACET_LEAK_SANITIZER
  leaks_allowed() { __lsan_disable(); }
  ~leaks_allowed() { __lsan_enable(); }
#endif
};

}  // namespace

TEST_CASE("an EXR comes back bit for bit, before any clamp") {
  const temporary_folder folder;
  picture p = pattern(33, 17);
  p.at(4, 4)[0] = 1e20f;
  p.at(5, 4)[0] = INFINITY;
  image::write_picture(folder / "p.exr", p);
  const picture q = image::read_picture(folder / "p.exr");
  CHECK(q.width == 33);
  CHECK(q.height == 17);
  CHECK(q.rgba == p.rgba);
}

TEST_CASE("a PNG comes back with the 8-bit levels that were meant, and says its own curve") {
  const temporary_folder folder;
  const picture p = pattern(37, 11);
  for (const transfer curve : {transfer::srgb, transfer::linear}) {
    image::write_picture(folder / "p.PNG", p, curve);
    const picture q = image::read_picture(folder / "p.PNG");
    REQUIRE(q.rgba.size() == p.rgba.size());
    CHECK(image::to_bytes(q, curve) == image::to_bytes(p, curve));
    const picture given = image::read_picture(folder / "p.PNG", curve);
    CHECK(given.rgba == q.rgba);
  }
}

TEST_CASE("a picture with NaN is not written and what was there stays") {
  const temporary_folder folder;
  picture p(2, 2);
  p.at(1, 1)[2] = NAN;
  for (const char* name : {"p.png", "p.exr"}) {
    test::put(folder / name, "old");
    CHECK_THROWS_AS(image::write_picture(folder / name, p), image::nan_error);
    CHECK(test::content_of(folder / name) == "old");
  }
  CHECK(folder.names() == std::vector<std::string>{"p.exr", "p.png"});
}

TEST_CASE("a full disk is an output error with its reason, for PNG and EXR") {
  const temporary_folder folder;
  // Large enough to be written before the file is closed, and small enough not to be.
  for (const picture& p : {pattern(200, 200), picture(1, 1)})
    for (const char* name : {"full.png", "full.exr"}) {
      std::filesystem::remove(folder / name);
      std::filesystem::create_symlink("/dev/full", folder / name);
      CHECK(contains(message_of(folder / name, p), "No space left on device"));
    }
  CHECK(folder.names() == std::vector<std::string>{"full.exr", "full.png"});
}

TEST_CASE("a missing folder is an output error") {
  const temporary_folder folder;
  CHECK(contains(message_of(folder / "no" / "p.png", picture(1, 1)), "does not exist"));
}

TEST_CASE("other extensions are refused") {
  const temporary_folder folder;
  CHECK_THROWS_WITH_AS(image::write_picture(folder / "p.gif", picture(1, 1)),
                       "\".gif\" is not .png or .exr", std::invalid_argument);
  CHECK(folder.names().empty());
}

TEST_CASE("what is not a picture is a scene error that names the file") {
  const temporary_folder folder;
  test::put(folder / "text.png", "this is no picture");
  CHECK_THROWS_AS(image::read_picture(folder / "text.png"), scene_error);
  CHECK_THROWS_AS(image::read_picture(folder / "no.png"), scene_error);
  CHECK_THROWS_AS(image::read_picture(folder.path()), scene_error);
}

TEST_CASE("a picture cut short is an error") {
  const temporary_folder folder;
  for (const char* name : {"p.png", "p.exr"}) {
    image::write_picture(folder / name, pattern(64, 64));
    const std::string whole = test::content_of(folder / name);
    for (const std::size_t kept : {whole.size() / 8, whole.size() / 2}) {
      test::put(folder / name, whole.substr(0, kept));
      [[maybe_unused]] const leaks_allowed here;
      CHECK_THROWS_AS(image::read_picture(folder / name), scene_error);
    }
  }
}
#endif
