#include "image/output.hpp"

#include <doctest/doctest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/temporary_folder.hpp"

using namespace facet;
using test::content_of;
using test::put;
namespace fs = std::filesystem;

namespace {

std::string message_of(const fs::path& target) {
  try {
    image::write_file(target, "content");
  } catch (const image::output_error& e) {
    CHECK(e.path() == target);
    return e.what();
  }
  return "no error";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("a file is written whole and nothing else is left in its folder") {
  const test::temporary_folder folder;
  image::write_file(folder / "a.txt", "first");
  CHECK(content_of(folder / "a.txt") == "first");
  image::write_file(folder / "a.txt", "second");
  CHECK(content_of(folder / "a.txt") == "second");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("without commit the old file stands and the temporary is gone") {
  const test::temporary_folder folder;
  put(folder / "a.txt", "old");
  {
    image::output_file file(folder / "a.txt");
    file.write("new content", 11);
    CHECK(content_of(folder / "a.txt") == "old");
    CHECK(folder.names().size() == 2);
  }
  CHECK(content_of(folder / "a.txt") == "old");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("writes at an offset land there") {
  const test::temporary_folder folder;
  image::output_file file(folder / "a.txt");
  file.write("abcdef", 6);
  file.write_at("XY", 2, 1);
  file.write_at("ghi", 3, 6);
  file.write("j", 1);
  file.commit();
  CHECK(content_of(folder / "a.txt") == "aXYdefghij");
}

TEST_CASE("two files under way to one target do not disturb each other: the last commit wins") {
  const test::temporary_folder folder;
  image::output_file one(folder / "a.txt"), two(folder / "a.txt");
  one.write("one", 3);
  two.write("two", 3);
  two.commit();
  CHECK(content_of(folder / "a.txt") == "two");
  one.commit();
  CHECK(content_of(folder / "a.txt") == "one");
}

TEST_CASE("a replaced file keeps its permissions") {
  const test::temporary_folder folder;
  put(folder / "a.txt", "old");
  fs::permissions(folder / "a.txt", fs::perms(0640));
  image::write_file(folder / "a.txt", "new");
  CHECK(fs::status(folder / "a.txt").permissions() == fs::perms(0640));
}

TEST_CASE("a symbolic link stays a link and its target is written") {
  const test::temporary_folder folder;
  fs::create_directory(folder / "deep");
  fs::create_symlink("deep/real.txt", folder / "link.txt");
  image::write_file(folder / "link.txt", "content");
  CHECK(fs::is_symlink(folder / "link.txt"));
  CHECK(content_of(folder / "deep" / "real.txt") == "content");
}

TEST_CASE("a missing folder is named") {
  const test::temporary_folder folder;
  const std::string message = message_of(folder / "no" / "where.txt");
  CHECK(contains(message, (folder / "no").string()));
  CHECK(contains(message, "does not exist"));
  CHECK(folder.names().empty());
}

TEST_CASE("a folder is no file") {
  const test::temporary_folder folder;
  CHECK(contains(message_of(folder.path()), "is a folder"));
  CHECK(contains(message_of(folder.path() / ""), "names a folder"));
}

TEST_CASE("a folder in which nothing can be made gives the reason") {
  // /proc refuses new files to everybody, root included.
  CHECK(contains(message_of("/proc/facet.txt"), "no file can be made in its folder: "));
}

TEST_CASE("a file without write permission is kept" *
          doctest::skip(::geteuid() == 0)) {  // root may write anything
  const test::temporary_folder folder;
  put(folder / "a.txt", "old");
  fs::permissions(folder / "a.txt", fs::perms(0444));
  CHECK(contains(message_of(folder / "a.txt"), "cannot be written: Permission denied"));
  CHECK(content_of(folder / "a.txt") == "old");
}

TEST_CASE("a full disk is an error, and the device is still a device") {
  REQUIRE(fs::is_character_file("/dev/full"));
  CHECK(contains(message_of("/dev/full"), "No space left on device"));
  CHECK(fs::is_character_file("/dev/full"));
  const test::temporary_folder folder;
  fs::create_symlink("/dev/full", folder / "full.txt");
  CHECK(contains(message_of(folder / "full.txt"), "No space left on device"));
}

TEST_CASE("a device is written in place") {
  image::write_file("/dev/null", "content");
  CHECK(fs::is_character_file("/dev/null"));
}

TEST_CASE("checking an output changes nothing") {
  const test::temporary_folder folder;
  put(folder / "a.txt", "old");
  image::check_output(folder / "a.txt");
  image::check_output(folder / "b.txt");
  image::check_output("/dev/full");
  CHECK(content_of(folder / "a.txt") == "old");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
  CHECK_THROWS_AS(image::check_output(folder / "no" / "b.txt"), image::output_error);
  CHECK_THROWS_AS(image::check_output(folder.path()), image::output_error);
}

TEST_CASE("checking a pipe neither waits for its reader nor ends it") {
  const test::temporary_folder folder;
  REQUIRE(::mkfifo((folder / "pipe").c_str(), 0600) == 0);
  image::check_output(folder / "pipe");
  CHECK(fs::is_fifo(folder / "pipe"));
}

TEST_CASE(
    "one file by two names is the same file, there or not; two files with one content are not") {
  const test::temporary_folder folder;
  put(folder / "a", "content");
  put(folder / "b", "content");
  fs::create_symlink(folder / "a", folder / "link");
  CHECK(image::same_file(folder / "a", folder.path() / "." / "a"));
  CHECK(image::same_file(folder / "a", folder / "link"));
  CHECK(image::same_file(folder / "none", folder.path() / "." / "none"));
  CHECK(!image::same_file(folder / "a", folder / "b"));
  CHECK(!image::same_file(folder / "a", folder / "none"));
}
